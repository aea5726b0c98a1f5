// SPDX-License-Identifier: MIT
#include "firmware/ingest/named_points.h"

#include <algorithm>
#include <set>
#include <utility>

#include "firmware/ingest/csv_table.h"
#include "firmware/ingest/number.h"
#include "firmware/ingest/photo_names.h"
#include "firmware/ingest/table_reader.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

// A weight must stay finite: a length said to be exact is taken as good to this.
constexpr double kLeastLengthSigmaM = 1e-4;

// What is wrong with a length; empty where nothing is.
std::string fault_of(const survey::NamedLength& length) {
  if (length.point_a.empty() || length.point_b.empty()) return "a point has no name.";
  if (length.point_a == length.point_b) {
    return "both ends of the length are " + in_quotes(length.point_a) + ".";
  }
  if (!(length.metres > 0)) return "a length must be greater than 0 m.";
  if (!(length.sigma_m >= 0)) return "a standard deviation is 0 or more.";
  return "";
}

}  // namespace

Result<Picks> read_picks(const std::filesystem::path& path,
                         const std::vector<std::string>& photo_names) {
  const Result<CsvTable> table = read_csv(path);
  if (!table) return table.error();
  TableReader reader(*table);
  reader.require({"photo", "point", "u_px", "v_px"});
  const PhotoNames photos(photo_names);
  std::set<std::pair<int, std::string>> seen;
  Picks result;
  for (const CsvRow& row : table->rows) {
    if (reader.error()) break;
    const std::string photo = reader.text(row, "photo");
    survey::NamedPick pick;
    pick.point = reader.text(row, "point");
    pick.pixel = {reader.number(row, "u_px"), reader.number(row, "v_px")};
    pick.sigma_px = reader.sigma_or_blank(row, "sigma_px");
    if (pick.sigma_px == 0) reader.fail(row, "'sigma_px' must be greater than 0.");
    const std::optional<int> index = photos.index_of(photo);
    if (!index) reader.fail(row, "there is no photo " + in_quotes(photo) + " among those given.");
    pick.photo = index.value_or(0);
    if (!seen.emplace(pick.photo, pick.point).second) {
      reader.fail(row, "the point " + in_quotes(pick.point) + " is there twice in photo " +
                           in_quotes(photo) + ".");
    }
    result.picks.push_back(std::move(pick));
  }
  if (reader.error()) return *reader.error();
  if (result.picks.empty()) return Error{table->name + ": there are no picks in it."};
  result.notices = reader.notices();
  return result;
}

Result<Lengths> read_lengths(const std::filesystem::path& path) {
  const Result<CsvTable> table = read_csv(path);
  if (!table) return table.error();
  TableReader reader(*table);
  reader.require({"point_a", "point_b", "length_m"});
  reader.expect({"sigma_m"});
  std::set<std::pair<std::string, std::string>> seen;
  Lengths result;
  for (const CsvRow& row : table->rows) {
    if (reader.error()) break;
    survey::NamedLength length{reader.text(row, "point_a"), reader.text(row, "point_b"),
                               reader.number(row, "length_m"),
                               reader.sigma_or_blank(row, "sigma_m").value_or(kLengthSigmaM)};
    if (const std::string fault = fault_of(length); !fault.empty()) reader.fail(row, fault);
    if (!seen.insert(std::minmax(length.point_a, length.point_b)).second) {
      reader.fail(row, "the length from " + in_quotes(length.point_a) + " to " +
                           in_quotes(length.point_b) + " is there twice.");
    }
    length.sigma_m = std::max(length.sigma_m, kLeastLengthSigmaM);
    result.lengths.push_back(std::move(length));
  }
  if (reader.error()) return *reader.error();
  result.notices = reader.notices();
  if (result.lengths.empty()) {
    result.notices.push_back(table->name + ": there are no lengths in it.");
  }
  return result;
}

Result<survey::NamedLength> parse_length(const std::string& argument) {
  const auto bad = [&](const std::string& why) {
    return Error{"The length " + in_quotes(argument) + " cannot be used: " + why +
                 " Write it as A,B,METRES or A,B,METRES,SIGMA."};
  };
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= argument.size();) {
    const std::size_t comma = std::min(argument.find(',', at), argument.size());
    parts.emplace_back(trimmed(std::string_view(argument).substr(at, comma - at)));
    at = comma + 1;
  }
  if (parts.size() != 3 && parts.size() != 4) return bad("it has not three or four parts.");
  const std::optional<double> metres = parse_number(parts[2]);
  const std::optional<double> sigma_m =
      parts.size() == 4 ? parse_number(parts[3]) : std::optional(kLengthSigmaM);
  if (!metres || !sigma_m) return bad("a part that should be a number is none.");
  survey::NamedLength length{parts[0], parts[1], *metres, *sigma_m};
  if (const std::string fault = fault_of(length); !fault.empty()) return bad(fault);
  length.sigma_m = std::max(length.sigma_m, kLeastLengthSigmaM);
  return length;
}

}  // namespace plumbline::ingest
