// SPDX-License-Identifier: MIT
#include "edge/geodesy/geoid_reader.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace plumbline::geodesy {
namespace {

constexpr double kMaxNodes = 100e6;  // the globe at 2.5 minutes has 37 million

std::string_view trimmed(std::string_view text) {
  const char* const blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

// Finite numbers found in `text`, whatever stands between them.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool found = error == std::errc{} && std::isfinite(value);
    if (found) numbers.push_back(value);
    at = next > at ? next : at + 1;
  }
  return numbers;
}

// 15.5, or 15°30'00" (coord units dms).
std::optional<double> degrees_in(std::string_view text) {
  const std::vector<double> parts = numbers_in(text);
  if (parts.empty()) return std::nullopt;
  double fraction = 0;
  for (std::size_t i = std::min<std::size_t>(parts.size(), 3) - 1; i > 0; --i) {
    fraction = (fraction + std::abs(parts[i])) / 60;
  }
  const bool south_or_west = text.find('-') != std::string_view::npos;
  const double magnitude = std::abs(parts[0]) + fraction;
  return south_or_west ? -magnitude : magnitude;
}

}  // namespace

Error GeoidReader::bad(const std::string& why) const {
  return {"The geoid model '" + geoid_.name_ + "' cannot be used: " + why + "."};
}

Status GeoidReader::check_size(double rows, double columns) const {
  if (rows >= 2 && columns >= 2 && rows * columns <= kMaxNodes && rows == std::floor(rows) &&
      columns == std::floor(columns)) {
    return Done{};
  }
  return bad("its grid must have at least 2 x 2 and at most 100 million nodes");
}

Result<Geoid> GeoidReader::read_pgm(std::string_view text) {
  std::optional<double> offset_m;
  std::optional<double> scale_m;
  std::vector<double> size;  // columns, rows, largest value
  take_line(text);
  while (size.size() < 3 && !text.empty()) {
    const std::string_view line = take_line(text);
    const std::vector<double> numbers = numbers_in(line);
    if (!line.starts_with('#')) {
      size.insert(size.end(), numbers.begin(), numbers.end());
    } else if (line.starts_with("# Offset ") && !numbers.empty()) {
      offset_m = numbers[0];
    } else if (line.starts_with("# Scale ") && !numbers.empty()) {
      scale_m = numbers[0];
    }
  }
  if (!offset_m || !scale_m) return bad("its head has no '# Offset' or no '# Scale'");
  if (size.size() != 3 || size[2] != 65535) return bad("it is not a 16-bit .pgm");
  if (const Status fits = check_size(size[1], size[0]); !fits) return fits.error();
  geoid_.columns_ = static_cast<int>(size[0]);
  geoid_.rows_ = static_cast<int>(size[1]);
  const std::size_t nodes = static_cast<std::size_t>(size[0] * size[1]);
  if (text.size() < 2 * nodes) return bad("it is cut short");
  geoid_.north_deg_ = 90;
  geoid_.west_deg_ = 0;
  geoid_.step_lat_deg_ = 180.0 / (geoid_.rows_ - 1);
  geoid_.step_lon_deg_ = 360.0 / geoid_.columns_;
  geoid_.around_the_globe_ = true;
  geoid_.heights_m_.reserve(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    const int high = static_cast<unsigned char>(text[2 * i]);
    const int low = static_cast<unsigned char>(text[2 * i + 1]);
    geoid_.heights_m_.push_back(static_cast<float>(*offset_m + *scale_m * (256 * high + low)));
  }
  return std::move(geoid_);
}

Result<Geoid> GeoidReader::read_isg(std::string_view text) {
  Head head;
  bool in_head = false;
  while (!text.empty()) {
    const std::string_view line = take_line(text);
    if (line.starts_with("end_of_head")) break;
    const std::size_t mark = line.find_first_of(":=");
    if (in_head && mark != std::string_view::npos) {
      head.emplace(trimmed(line.substr(0, mark)), trimmed(line.substr(mark + 1)));
    }
    in_head = in_head || line.starts_with("begin_of_head");
  }
  const auto is_not = [&head](const char* key, const char* wanted) {
    const auto found = head.find(key);
    return found != head.end() && found->second != wanted;
  };
  if (is_not("data format", "grid")) return bad("its data format is not 'grid'");
  if (is_not("coord type", "geodetic")) return bad("its coord type is not 'geodetic'");
  if (is_not("data ordering", "N-to-S, W-to-E")) {
    return bad("its data ordering is not 'N-to-S, W-to-E'");
  }
  if (is_not("data units", "meters")) return bad("its data units are not 'meters'");
  if (const Status placed = place_isg_grid(head); !placed) return placed.error();
  const std::vector<double> nodata = numbers_in(head["nodata"]);
  const double none = nodata.empty() ? -9999 : nodata[0];
  if (const Status filled = fill_isg(text, none); !filled) return filled.error();
  return std::move(geoid_);
}

Status GeoidReader::place_isg_grid(const Head& head) {
  std::map<std::string, double, std::less<>> value;
  for (const char* key :
       {"lat min", "lat max", "lon min", "lon max", "delta lat", "delta lon", "nrows", "ncols"}) {
    const auto found = head.find(key);
    const std::optional<double> number =
        found == head.end() ? std::nullopt : degrees_in(found->second);
    if (!number) return bad(std::string("its head has no '") + key + "'");
    value[key] = *number;
  }
  if (const Status fits = check_size(value["nrows"], value["ncols"]); !fits) return fits;
  if (!(value["delta lat"] > 0 && value["delta lon"] > 0)) return bad("its steps are not positive");
  geoid_.rows_ = static_cast<int>(value["nrows"]);
  geoid_.columns_ = static_cast<int>(value["ncols"]);
  // Limits are those of the nodes, or of the cells around them; the counts tell which. The steps
  // follow from limits and counts, for many heads round them.
  const double lat_cells = (value["lat max"] - value["lat min"]) / value["delta lat"];
  const double lon_cells = (value["lon max"] - value["lon min"]) / value["delta lon"];
  const bool by_nodes = std::abs(lat_cells - (geoid_.rows_ - 1)) < 0.3 &&
                        std::abs(lon_cells - (geoid_.columns_ - 1)) < 0.3;
  const bool by_cells =
      std::abs(lat_cells - geoid_.rows_) < 0.3 && std::abs(lon_cells - geoid_.columns_) < 0.3;
  if (!by_nodes && !by_cells) return bad("its limits, steps and counts contradict each other");
  const int less = by_nodes ? 1 : 0;
  geoid_.step_lat_deg_ = (value["lat max"] - value["lat min"]) / (geoid_.rows_ - less);
  geoid_.step_lon_deg_ = (value["lon max"] - value["lon min"]) / (geoid_.columns_ - less);
  geoid_.north_deg_ = value["lat max"] - (by_nodes ? 0 : 0.5 * geoid_.step_lat_deg_);
  geoid_.west_deg_ = value["lon min"] + (by_nodes ? 0 : 0.5 * geoid_.step_lon_deg_);
  geoid_.around_the_globe_ = std::abs(geoid_.step_lon_deg_ * geoid_.columns_ - 360) < 1e-6;
  return Done{};
}

Status GeoidReader::fill_isg(std::string_view numbers, double nodata) {
  const auto nodes =
      static_cast<std::size_t>(geoid_.rows_) * static_cast<std::size_t>(geoid_.columns_);
  geoid_.heights_m_.reserve(std::min(nodes, numbers.size()));
  const char* at = numbers.data();
  const char* const end = at + numbers.size();
  while (geoid_.heights_m_.size() < nodes) {
    while (at < end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')) ++at;
    double height_m = 0;
    const auto [next, error] = std::from_chars(at, end, height_m);
    if (error != std::errc{} || !(std::abs(height_m) < 1e6)) {
      return bad("it is cut short, or holds what is not a number, at node " +
                 std::to_string(geoid_.heights_m_.size() + 1));
    }
    at = next;
    geoid_.heights_m_.push_back(height_m == nodata ? std::numeric_limits<float>::quiet_NaN()
                                                   : static_cast<float>(height_m));
  }
  return Done{};
}

}  // namespace plumbline::geodesy
