// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// What `measure` and `orient` print at the end: photos and ties used, image sigma, accuracy of the
// points per axis, check points where given, what is not observable, warnings. Plain text, lines
// ended by \n, 100 columns where names allow.
std::string accuracy_table(const Product& product);

// summary.json (also what --json prints): keys as in the format's description; unknown = null.
// Rounded to eight significant digits, so that it is short and the same everywhere.
std::string summary_json(const Product& product);

}  // namespace plumbline::deliver
