// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/base/result.h"
#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// The tables of a result, one header line each; metres, degrees and pixels as the column names say,
// blank where unknown. Lengths to 1e-6 m, angles to 1e-7 deg, latitude and longitude to 1e-10 deg,
// pixels to 1e-4.

// The measured points. Fails where the product's origin or zone is not sensible.
Result<std::string> points_csv(const Product& product);
// All photos; those not oriented with blanks.
std::string photos_csv(const Product& product);
// All image observations; the residual of one whose photo or point is not known is blank.
std::string observations_csv(const Product& product);
// Check points measured, and those not with blanks.
std::string check_csv(const survey::CheckReport& check);

}  // namespace plumbline::deliver
