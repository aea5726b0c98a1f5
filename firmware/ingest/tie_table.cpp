// SPDX-License-Identifier: MIT
#include "firmware/ingest/tie_table.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "firmware/ingest/csv_table.h"
#include "firmware/ingest/photo_names.h"
#include "firmware/ingest/table_reader.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {

Result<image::TiePoints> read_ties(const std::filesystem::path& path,
                                   const std::vector<std::string>& photo_names,
                                   const std::set<std::string>& named_now) {
  const Result<CsvTable> table = read_csv(path);
  if (!table) return table.error();
  TableReader reader(*table);
  reader.require({"photo", "point", "u_px", "v_px", "sigma_px"});
  const PhotoNames photos(photo_names);
  std::map<std::string, int> index_of_point;
  image::TiePoints ties;
  for (const CsvRow& row : table->rows) {
    if (reader.error()) break;
    const std::string photo = reader.text(row, "photo"), point = reader.text(row, "point");
    image::TieObservation tie;
    tie.pixel = {reader.number(row, "u_px"), reader.number(row, "v_px")};
    const double sigma_px = reader.sigma_or_blank(row, "sigma_px").value_or(0);
    if (!(sigma_px > 0)) reader.fail(row, "'sigma_px' must be greater than 0.");
    tie.covariance_px2 *= sigma_px * sigma_px;
    const auto index = photos.index_of(photo);
    if (!index) reader.fail(row, "there is no photo " + in_quotes(photo) + " among those given.");
    tie.photo = index.value_or(0);
    if (named_now.contains(point)) continue;
    tie.point =
        index_of_point.try_emplace(point, static_cast<int>(index_of_point.size())).first->second;
    ties.observations.push_back(tie);
  }
  if (reader.error()) return *reader.error();
  if (ties.observations.empty()) return Error{table->name + ": there are no tie points in it."};
  ties.point_count = static_cast<int>(index_of_point.size());
  std::sort(ties.observations.begin(), ties.observations.end(), [](const auto& a, const auto& b) {
    return std::tie(a.point, a.photo) < std::tie(b.point, b.photo);
  });
  return ties;
}

}  // namespace plumbline::ingest
