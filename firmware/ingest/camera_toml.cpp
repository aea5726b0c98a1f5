// SPDX-License-Identifier: MIT
#include "firmware/ingest/camera_toml.h"

#include <toml++/toml.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "firmware/ingest/number.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

using geometry::Camera;
using geometry::InteriorMatrix;
using geometry::InteriorVector;
using geometry::kInteriorCount;

// A key of the file and the entries of the interior vector that it holds.
struct Key {
  const char* name;
  int first;
  int count;
  bool is_list;
};
constexpr std::array<Key, 6> kKeys = {{{"focal_length_px", geometry::kFocalLength, 1, false},
                                       {"principal_point_px", geometry::kPrincipalU, 2, true},
                                       {"affinity", geometry::kAffinity, 1, false},
                                       {"skew", geometry::kSkew, 1, false},
                                       {"radial", geometry::kRadial1, 3, true},
                                       {"tangential", geometry::kTangential1, 2, true}}};

using Aliases = std::array<std::array<const char*, 2>, kInteriorCount>;
constexpr Aliases kAliases = {{{"f", "focal_length"},
                               {"cu", "principal_point_px[0]"},
                               {"cv", "principal_point_px[1]"},
                               {"affinity", "affinity"},
                               {"skew", "skew"},
                               {"k1", "radial[0]"},
                               {"k2", "radial[1]"},
                               {"k3", "radial[2]"},
                               {"p1", "tangential[0]"},
                               {"p2", "tangential[1]"}}};

constexpr int kMaxSidePx = 100'000;
constexpr double kLeastEigenvalue = 1e-12;  // of a correlation matrix: else it has no inverse

std::optional<int> interior_index(const std::string& name) {
  for (int i = 0; i < kInteriorCount; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (name == geometry::kInteriorNames[at] || name == kAliases[at][0] || name == kAliases[at][1])
      return i;
  }
  return std::nullopt;
}

std::string interior_names() {
  std::string names;
  for (const char* name : geometry::kInteriorNames)
    names.append(names.empty() ? "" : ", ").append(name);
  return names;
}

bool holds_nothing(const toml::table& table, const char* key) {
  const toml::node* node = table.get(key);
  return node == nullptr || (node->is_array() && node->as_array()->empty());
}

class Reader {
 public:
  explicit Reader(std::string name) : name_(std::move(name)) {}

  Result<CameraFile> read(const toml::table& file) {
    read_size(file);
    read_values(file);
    notice_unknown(file, {"name", "width_px", "height_px", "line_time_us", "sigma", "covariance"},
                   true);
    read_sigmas(file);
    read_covariance(file);
    if (error_) return *error_;
    return result_;
  }

 private:
  // Only the first fault is told.
  void fail(const toml::node* where, const std::string& sentence) {
    if (error_) return;
    error_ = Error{(where ? at_line(name_, where->source().begin.line) : name_ + ": ") + sentence};
  }

  static std::optional<double> number(const toml::node& node) {
    if (!node.is_number()) return std::nullopt;
    const double value = *node.value<double>();
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }

  int side(const toml::table& file, const char* key) {
    const toml::node* node = file.get(key);
    if (node == nullptr) {
      fail(nullptr, std::string(key) + " is missing; add the size of the photos in pixels.");
      return 0;
    }
    const double value = number(*node).value_or(0);
    if (value < 1 || value > kMaxSidePx || value != std::floor(value)) {
      fail(node, std::string(key) + " must be a whole number of pixels from 1 to " +
                     std::to_string(kMaxSidePx) + ".");
      return 0;
    }
    return static_cast<int>(value);
  }

  void read_size(const toml::table& file) {
    Camera& camera = result_.camera;
    camera.width_px = side(file, "width_px");
    camera.height_px = side(file, "height_px");
    const toml::node* node = file.get("name");
    if (node && !node->is_string()) fail(node, "name must be a text in quotes.");
    if (node) camera.name = node->value_or<std::string>("");
  }

  // One entry into `values`; `free_allowed` for sigmas.
  void read_entry(const toml::node& node, const Key& key, int entry, bool is_sigma,
                  InteriorVector& values) {
    if (is_sigma && node.is_string() && *node.value<std::string>() == "free") {
      values[entry] = geometry::kFree;
      said_free_.insert(entry);
      return;
    }
    const std::optional<double> value = number(node);
    if (!value) {
      return fail(&node, std::string(key.name) + " must be " +
                             (key.is_list ? std::to_string(key.count) + " finite numbers"
                                          : std::string("a finite number")) +
                             (is_sigma ? " or the word \"free\"." : "."));
    }
    if (is_sigma && *value < 0) {
      return fail(&node, "the sigma of " + std::string(key.name) +
                             " is negative; a standard deviation is 0 (held fixed) or more.");
    }
    values[entry] = *value;
  }

  void read_key(const toml::table& table, const Key& key, bool is_sigma, InteriorVector& values) {
    const toml::node* node = table.get(key.name);
    if (node == nullptr) return;
    if (!key.is_list) return read_entry(*node, key, key.first, is_sigma, values);
    const toml::array* list = node->as_array();
    if (list == nullptr || list->size() != static_cast<std::size_t>(key.count)) {
      return fail(node, std::string(key.name) + " must be a list of " + std::to_string(key.count) +
                            " numbers.");
    }
    for (int i = 0; i < key.count; ++i) {
      read_entry(*list->get(static_cast<std::size_t>(i)), key, key.first + i, is_sigma, values);
    }
  }

  void read_values(const toml::table& file) {
    Camera& camera = result_.camera;
    InteriorVector& interior = camera.interior;
    interior[geometry::kPrincipalU] = 0.5 * (camera.width_px - 1);
    interior[geometry::kPrincipalV] = 0.5 * (camera.height_px - 1);
    for (const Key& key : kKeys) read_key(file, key, false, interior);
    const toml::node* focal = file.get("focal_length_px");
    if (focal == nullptr) {
      fail(nullptr, "focal_length_px is missing; add the principal distance in pixels.");
    } else if (!(interior[geometry::kFocalLength] > 0)) {
      fail(focal, "focal_length_px must be greater than 0.");
    }
    if (!(interior[geometry::kAffinity] > -1)) {
      fail(file.get("affinity"), "affinity must be greater than -1.");
    }
    camera.line_time_us = plain(file, "line_time_us");
  }

  double plain(const toml::table& table, const char* key) {
    const toml::node* node = table.get(key);
    if (node == nullptr) return 0;
    const std::optional<double> value = number(*node);
    if (!value || *value < 0) fail(node, std::string(key) + " must be a number of 0 or more.");
    return value.value_or(0);
  }

  const toml::table* section(const toml::table& file, const char* key) {
    const toml::node* node = file.get(key);
    if (node && !node->is_table()) fail(node, std::string(key) + " must be a section.");
    return node ? node->as_table() : nullptr;
  }

  void read_sigmas(const toml::table& file) {
    const toml::table* table = section(file, "sigma");
    has_sigma_ = table != nullptr;
    if (!has_sigma_) return;
    for (const Key& key : kKeys) read_key(*table, key, true, result_.camera.sigma);
    result_.camera.line_time_sigma_us = plain(*table, "line_time_us");
    notice_unknown(*table, {"line_time_us"}, true);
  }

  std::vector<int> read_order(const toml::table& table) {
    const toml::array* order = table["order"].as_array();
    if (order == nullptr) {
      fail(&table, "[covariance] needs 'order', a list of the names of its rows, out of " +
                       interior_names() + ".");
      return {};
    }
    std::vector<int> rows;
    for (const toml::node& node : *order) {
      const auto row = interior_index(node.value_or<std::string>(""));
      if (!row || std::ranges::count(rows, *row) > 0) {
        fail(&node,
             in_quotes(node.value_or<std::string>("")) + " in the order of [covariance] is " +
                 (row ? "there twice."
                      : "not one of the names of a camera's entries: " + interior_names() + "."));
        return {};
      }
      rows.push_back(*row);
    }
    return rows;
  }

  void read_row(const toml::node& node, int row, const std::vector<int>& rows,
                InteriorMatrix& covariance) {
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != rows.size()) {
      return fail(&node,
                  "each row of the matrix of [covariance] must have as many numbers as "
                  "'order' has names.");
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::optional<double> value = number(*list->get(i));
      if (!value) fail(list->get(i), "the matrix of [covariance] must hold finite numbers only.");
      covariance(row, rows[i]) = value.value_or(0);
    }
  }

  void read_covariance(const toml::table& file) {
    const toml::table* table = section(file, "covariance");
    if (table == nullptr) return;
    notice_unknown(*table, {"order", "matrix"}, false);
    if (holds_nothing(*table, "order") && holds_nothing(*table, "matrix")) return;
    const std::vector<int> rows = read_order(*table);
    const toml::array* matrix = (*table)["matrix"].as_array();
    if (matrix == nullptr || matrix->size() != rows.size()) {
      return fail(table,
                  "[covariance] needs 'matrix', a list of as many rows as 'order' has names.");
    }
    InteriorMatrix covariance = InteriorMatrix::Zero();
    keep_other_sigmas(rows, covariance);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      read_row(*matrix->get(i), rows[i], rows, covariance);
    }
    if (!error_) take_covariance(covariance, table);
  }

  // What neither the matrix nor [sigma] names is held fixed.
  void keep_other_sigmas(const std::vector<int>& rows, InteriorMatrix& covariance) {
    std::string fixed;
    for (int i = 0; i < kInteriorCount; ++i) {
      if (std::ranges::count(rows, i) > 0) continue;
      const double sigma = result_.camera.sigma[i];
      if (has_sigma_ && (std::isfinite(sigma) || said_free_.contains(i))) {
        covariance(i, i) = sigma * sigma;
      } else {
        fixed.append(fixed.empty() ? "" : ", ")
            .append(geometry::kInteriorNames[static_cast<std::size_t>(i)]);
      }
    }
    if (fixed.empty()) return;
    result_.notices.push_back(name_ + ": neither [covariance] nor [sigma] names " + fixed +
                              ": held fixed. Give a sigma, or the word \"free\", to what is not "
                              "known.");
  }

  void take_covariance(const InteriorMatrix& covariance, const toml::table* where) {
    const InteriorVector sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
    const InteriorMatrix scale = sigma * sigma.transpose();
    InteriorMatrix correlation = InteriorMatrix::Identity();
    for (int i = 0; i < kInteriorCount; ++i) {
      for (int j = 0; j < kInteriorCount; ++j) {
        const double asymmetry = std::abs(covariance(i, j) - covariance(j, i));
        if (covariance(i, i) < 0 || asymmetry > 1e-6 * scale(i, j) ||
            (scale(i, j) == 0 && covariance(i, j) != 0)) {
          return fail(where,
                      "the matrix of [covariance] is not symmetric or a variance in it is "
                      "negative.");
        }
        if (i != j && scale(i, j) > 0) correlation(i, j) = covariance(i, j) / scale(i, j);
      }
    }
    const double least = correlation.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
    if (!(least > kLeastEigenvalue)) {
      return fail(where,
                  "the matrix of [covariance] is not positive (a correlation of 1 or beyond).");
    }
    result_.camera.covariance = covariance;
    result_.camera.sigma = sigma;
  }

  void notice_unknown(const toml::table& table, const std::set<std::string_view>& known,
                      bool with_interior) {
    for (const auto& [key, node] : table) {
      const std::string_view name = key.str();
      const auto is_this = [name](const Key& k) { return name == k.name; };
      if (known.contains(name) || (with_interior && std::ranges::any_of(kKeys, is_this))) continue;
      result_.notices.push_back(at_line(name_, node.source().begin.line) + in_quotes(name) +
                                " is not known and was ignored.");
    }
  }

  std::string name_;
  CameraFile result_;
  bool has_sigma_ = false;
  std::set<int> said_free_;  // by the word
  std::optional<Error> error_;
};

}  // namespace

Result<CameraFile> parse_camera_toml(const std::string& text, const std::string& name) {
  try {
    const toml::table file = toml::parse(text, name);
    return Reader(name).read(file);
  } catch (const toml::parse_error& error) {
    return Error{at_line(name, error.source().begin.line) + "not valid TOML (" +
                 std::string(error.description()) + ")."};
  }
}

Result<CameraFile> read_camera_toml(const std::filesystem::path& path) {
  const Result<std::string> text = read_text_file(path, 1u << 20);
  if (!text) return text.error();
  return parse_camera_toml(*text, path.filename().string());
}

}  // namespace plumbline::ingest
