// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "edge/geodesy/geoid.h"

namespace plumbline::geodesy {

// The two file formats behind Geoid::parse.
// .pgm: https://geographiclib.sourceforge.io/C++/doc/geoid.html ; ISG: International Service for
// the Geoid, "ISG format 2.0".
class GeoidReader {
 public:
  explicit GeoidReader(std::string name) { geoid_.name_ = std::move(name); }

  Result<Geoid> read_pgm(std::string_view text);
  Result<Geoid> read_isg(std::string_view text);

 private:
  using Head = std::map<std::string, std::string, std::less<>>;

  Error bad(const std::string& why) const;
  Status check_size(double rows, double columns) const;
  Status place_isg_grid(const Head& head);
  Status fill_isg(std::string_view numbers, double nodata);

  Geoid geoid_;
};

}  // namespace plumbline::geodesy
