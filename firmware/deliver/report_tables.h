// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// The tables of the report as markup; each empty where it has nothing to say.
std::string reliance_table(const Product& product);
std::string ring_table(const Product& product);
std::string check_table(const survey::CheckReport& check);
std::string named_point_table(const Product& product);
std::string map_coordinate_table(const Product& product);
std::string station_table(const Product& product);
std::string attitude_table(const Product& product);
std::string camera_table(const Product& product);
std::string group_table(const Product& product);
std::string input_table(const Product& product);

// Beyond so many rows a table of points ends with a note that points to the CSV file.
inline constexpr std::size_t kMostRows = 200;

inline const std::string kSigma = "\xcf\x83 ";  // Greek small sigma

// A row of a table, and three figures more in it: a dash for what is not finite.
using Row = std::vector<std::string>;
void add_axes(Row& row, const Eigen::Vector3d& value, int decimals);

}  // namespace plumbline::deliver
