// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// The measurement as one page for a client: HTML with everything in it (style and figures), no
// script, nothing fetched, no date; also well-formed XML. The same product gives the same bytes.
// Prints on A4.
std::string report_html(const Product& product);

}  // namespace plumbline::deliver
