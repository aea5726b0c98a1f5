// SPDX-License-Identifier: MIT
#include "firmware/ingest/case_files.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "firmware/ingest/table_reader.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

void append(std::vector<std::string>& notices, const TableReader& reader) {
  for (std::string& notice : reader.notices()) notices.push_back(std::move(notice));
}

// A pixel that far outside the photo is a slip of units, not a measurement.
constexpr double kMaxOutside = 1.0;  // of the photo's size

bool is_near_photo(const geometry::Camera& camera, const Eigen::Vector2d& pixel) {
  const auto near = [](double at, int size) {
    return at >= -kMaxOutside * size && at <= (1 + kMaxOutside) * size;
  };
  return near(pixel.x(), camera.width_px) && near(pixel.y(), camera.height_px);
}

std::vector<std::string> names_of(const std::vector<orient::Photo>& photos) {
  std::vector<std::string> names;
  for (const orient::Photo& photo : photos) names.push_back(photo.name);
  return names;
}

}  // namespace

Result<PointNumbers> case_observations(const CsvTable& table, orient::Problem& problem,
                                       std::vector<std::string>& notices) {
  TableReader reader(table);
  reader.require({"photo", "point", "u_px", "v_px"});
  const PhotoNames photos(names_of(problem.photos));
  PointNumbers points;
  std::set<std::pair<int, int>> seen;
  for (const CsvRow& row : table.rows) {
    if (reader.error()) break;
    const std::string photo = reader.text(row, "photo");
    const std::string point = reader.text(row, "point");
    const std::optional<int> index = photos.index_of(photo);
    if (!index) reader.fail(row, "there is no photo " + in_quotes(photo) + " in photos.csv.");
    const auto [number, added] = points.emplace(point, static_cast<int>(points.size()));
    if (added) problem.point_names.push_back(point);
    orient::Observation observation{index.value_or(0), number->second};
    observation.pixel = {reader.number(row, "u_px"), reader.number(row, "v_px")};
    const auto sigma_px = reader.sigma_or_blank(row, "sigma_px");
    if (sigma_px && !(*sigma_px >= 1e-6)) reader.fail(row, "'sigma_px' must be greater than 0.");
    observation.group = sigma_px ? orient::ImageGroup::kStated : orient::ImageGroup::kPicks;
    observation.sigma_px = sigma_px.value_or(1);
    if (!is_near_photo(problem.camera, observation.pixel)) {
      reader.fail(row, "the pixel lies far outside a photo of " +
                           std::to_string(problem.camera.width_px) + " x " +
                           std::to_string(problem.camera.height_px) + " (camera.toml).");
    }
    if (!seen.emplace(observation.photo, observation.point).second) {
      reader.fail(row, "the point " + in_quotes(point) + " is there twice in photo " +
                           in_quotes(photo) + ".");
    }
    problem.observations.push_back(observation);
  }
  if (reader.error()) return *reader.error();
  if (problem.observations.empty()) {
    return Error{table.name + ": there are no observations in it."};
  }
  append(notices, reader);
  return points;
}

Result<orient::FrameRoles> case_frame_roles(const CsvTable& table, const PointNumbers& points,
                                            std::vector<std::string>& notices) {
  TableReader reader(table);
  reader.require({"role", "point"});
  std::map<std::string, int, std::less<>> found;
  for (const CsvRow& row : table.rows) {
    if (reader.error()) break;
    const std::string role = reader.text(row, "role");
    const std::string point = reader.text(row, "point");
    const auto number = points.find(point);
    if (number == points.end()) {
      reader.fail(row, "the point " + in_quotes(point) + " is not in observations.csv.");
    } else if (role != "origin" && role != "x_axis" && role != "plane") {
      reader.fail(row, in_quotes(role) + " is no role; there are origin, x_axis and plane.");
    } else if (!found.emplace(role, number->second).second) {
      reader.fail(row, "the role " + in_quotes(role) + " is there twice.");
    }
  }
  if (reader.error()) return *reader.error();
  if (found.size() != 3) {
    return Error{table.name + ": each of the roles origin, x_axis and plane is wanted."};
  }
  const orient::FrameRoles roles{found["origin"], found["x_axis"], found["plane"]};
  if (roles.origin == roles.x_axis || roles.origin == roles.plane || roles.x_axis == roles.plane) {
    return Error{table.name + ": the three roles need three different points."};
  }
  append(notices, reader);
  return roles;
}

Result<orient::LeverArm> case_lever_arm(const CsvTable& table, std::vector<std::string>& notices) {
  TableReader reader(table);
  reader.require({"right_m", "up_m", "back_m"});
  if (reader.error()) return *reader.error();
  if (table.rows.size() != 1) return Error{table.name + ": one row below the header is wanted."};
  const CsvRow& row = table.rows.front();
  orient::LeverArm arm;
  arm.in_photo_m = {reader.number(row, "right_m"), reader.number(row, "up_m"),
                    reader.number(row, "back_m")};
  arm.sigma_m = reader.sigma_or_blank(row, "sigma_m").value_or(0);
  constexpr double kLongestM = 100;
  if (arm.in_photo_m.norm() > kLongestM) {
    reader.fail(row, "a lever arm of more than 100 m cannot be; it is given in metres.");
  }
  if (reader.error()) return *reader.error();
  append(notices, reader);
  return arm;
}

namespace {

class GnssTomlReader {
 public:
  explicit GnssTomlReader(const std::string& name) : name_(name) {}

  Result<CaseGnss> read(const toml::table& file, std::vector<std::string>& notices) {
    for (const auto& [key, node] : file) {
      if (!read_key(key.str(), node)) {
        notices.push_back(at_line(name_, node.source().begin.line) + in_quotes(key.str()) +
                          " is not known and was ignored.");
      }
    }
    if (error_) return *error_;
    if (has_correlated_sigma_ && model_.correlation_s == 0) {
      return Error{name_ + ": correlated_sigma_m needs correlation_s greater than 0."};
    }
    return CaseGnss{model_, delay_};
  }

 private:
  bool read_key(std::string_view key, const toml::node& node) {
    if (key == "offset_sigma_m") {
      std::tie(model_.offset_sigma_horizontal_m, model_.offset_sigma_vertical_m) = pair(node, key);
    } else if (key == "correlated_sigma_m") {
      std::tie(model_.correlated_sigma_horizontal_m, model_.correlated_sigma_vertical_m) =
          pair(node, key);
      has_correlated_sigma_ = true;
    } else if (key == "correlation_s") {
      model_.correlation_s = number(&node, key);
    } else if (key == "delay_s") {
      delay_.seconds = any_number(node, key);
    } else if (key == "delay_sigma_s") {
      delay_.sigma_s = number(&node, key);
    } else {
      return false;
    }
    return true;
  }

  double number(const toml::node* node, std::string_view key) {
    constexpr double kMost = 1e6;
    const double value = node && node->is_number() ? node->value_or(-1.0) : -1;
    if (value >= 0 && value <= kMost) return value;
    if (!error_ && node) {
      error_ = Error{at_line(name_, node->source().begin.line) + std::string(key) +
                     " must be a finite number of 0 or more."};
    }
    return 0;
  }

  double any_number(const toml::node& node, std::string_view key) {
    constexpr double kMostSeconds = 3600;
    const double value = node.is_number() ? node.value_or(kMostSeconds + 1) : kMostSeconds + 1;
    if (std::abs(value) <= kMostSeconds) return value;
    if (!error_) {
      error_ = Error{at_line(name_, node.source().begin.line) + std::string(key) +
                     " must be a number of seconds, less than an hour."};
    }
    return 0;
  }

  std::pair<double, double> pair(const toml::node& node, std::string_view key) {
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != 2) {
      if (!error_) {
        error_ = Error{at_line(name_, node.source().begin.line) + std::string(key) +
                       " must be a list of two numbers: horizontal and vertical."};
      }
      return {0, 0};
    }
    return {number(list->get(0), key), number(list->get(1), key)};
  }

  std::string name_;
  orient::GnssErrorModel model_;
  orient::Delay delay_;
  bool has_correlated_sigma_ = false;
  std::optional<Error> error_;
};

}  // namespace

Result<CaseGnss> case_gnss(const std::string& text, const std::string& name,
                           std::vector<std::string>& notices) {
  try {
    return GnssTomlReader(name).read(toml::parse(text, name), notices);
  } catch (const toml::parse_error& error) {
    return Error{at_line(name, error.source().begin.line) + "not valid TOML (" +
                 std::string(error.description()) + ")."};
  }
}

}  // namespace plumbline::ingest
