// SPDX-License-Identifier: MIT
#include "firmware/deliver/deliver.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "firmware/deliver/csv_files.h"
#include "firmware/deliver/report.h"
#include "firmware/deliver/staged_folder.h"
#include "firmware/deliver/table.h"
#include "firmware/deliver/text.h"
#include "firmware/ingest/camera_toml.h"

namespace plumbline::deliver {
namespace {

std::string timing_json(const Timing& timing) {
  nlohmann::ordered_json json;
  json["stages_s"] = nlohmann::ordered_json::object();
  double total_s = 0;
  for (const auto& [stage, seconds] : timing.stages_s) {
    json["stages_s"][clean_utf8(stage)] = seconds;
    total_s += seconds;
  }
  json["total_s"] = total_s;
  json["peak_memory_bytes"] = timing.peak_memory_bytes;
  return json.dump(2) + "\n";
}

}  // namespace

Status write(const Product& product, const Timing& timing, const std::filesystem::path& folder) {
  auto points = points_csv(product);
  if (!points) return points.error();
  std::vector<NamedFile> files = {{"summary.json", summary_json(product)},
                                  {"points.csv", *std::move(points)},
                                  {"photos.csv", photos_csv(product)},
                                  {"camera.toml", ingest::camera_toml(product.solution.camera)},
                                  {"observations.csv", observations_csv(product)},
                                  {"report.html", report_html(product)},
                                  {"timing.json", timing_json(timing)}};
  std::vector<std::string> obsolete;
  if (product.check)
    files.push_back({"check.csv", check_csv(*product.check)});
  else
    obsolete.push_back("check.csv");
  return write_all_or_nothing(folder, files, obsolete);
}

}  // namespace plumbline::deliver
