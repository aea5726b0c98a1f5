// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <vector>

#include "firmware/ingest/camera_toml.h"
#include "firmware/ingest/number.h"

namespace plumbline::ingest {
namespace {

using geometry::Camera;
using geometry::InteriorVector;
using geometry::kInteriorCount;

// TOML tells a float from an integer by its point or exponent.
std::string toml_number(double value) {
  std::string text = shortest(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_sigma(double value) { return std::isinf(value) ? "\"free\"" : toml_number(value); }

std::string toml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return quoted + "\"";
}

template <typename Format>
std::string line(const char* key, const InteriorVector& values, int first, int count,
                 const Format& format) {
  std::string text = std::string(key) + " = " + (count > 1 ? "[" : "");
  for (int i = 0; i < count; ++i) text += (i > 0 ? ", " : "") + format(values[first + i]);
  return text + (count > 1 ? "]\n" : "\n");
}

template <typename Format>
std::string ten_lines(const InteriorVector& values, const Format& format) {
  return line("focal_length_px", values, geometry::kFocalLength, 1, format) +
         line("principal_point_px", values, geometry::kPrincipalU, 2, format) +
         line("affinity", values, geometry::kAffinity, 1, format) +
         line("skew", values, geometry::kSkew, 1, format) +
         line("radial", values, geometry::kRadial1, 3, format) +
         line("tangential", values, geometry::kTangential1, 2, format);
}

std::string covariance_section(const geometry::InteriorMatrix& covariance) {
  std::vector<int> rows;
  for (int i = 0; i < kInteriorCount; ++i) {
    if (covariance(i, i) > 0) rows.push_back(i);
  }
  if (rows.empty()) return {};
  std::string order, matrix;
  for (const int row : rows) {
    order += (order.empty() ? "\"" : ", \"") +
             std::string(geometry::kInteriorNames[static_cast<std::size_t>(row)]) + "\"";
    matrix += matrix.empty() ? "\n    [" : ",\n    [";
    for (const int column : rows) {
      matrix += (column == rows.front() ? "" : ", ") + toml_number(covariance(row, column));
    }
    matrix += "]";
  }
  return "\n[covariance]\norder = [" + order + "]\nmatrix = [" + matrix + "]\n";
}

}  // namespace

std::string camera_toml(const Camera& camera) {
  const InteriorVector sigma =
      camera.covariance ? InteriorVector(camera.covariance->diagonal().cwiseMax(0).cwiseSqrt())
                        : camera.sigma;
  std::string text = "name = " + toml_text(camera.name) + "\n";
  text += "width_px = " + std::to_string(camera.width_px) + "\n";
  text += "height_px = " + std::to_string(camera.height_px) + "\n";
  text += ten_lines(camera.interior, toml_number);
  text += "line_time_us = " + toml_number(camera.line_time_us) + "\n";
  text += "\n# one standard deviation of each: 0 = held fixed\n[sigma]\n";
  text += ten_lines(sigma, toml_sigma);
  text += "line_time_us = " + toml_number(camera.line_time_sigma_us) + "\n";
  if (camera.covariance) text += covariance_section(*camera.covariance);
  return text;
}

}  // namespace plumbline::ingest
