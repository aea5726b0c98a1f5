// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// The parts of the report that are words, as markup.
std::string report_header(const Product& product);
std::string verdict_box(const Product& product);
std::string key_figures(const Product& product);
std::string unobservable_section(const Product& product);
std::string adjustment_section(const Product& product);
std::string glossary();
std::string report_footer();

}  // namespace plumbline::deliver
