// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// The stages of the published procedure with their intermediate results, as a text for the
// terminal; empty where the product was not made by it.
std::string paper_stages_text(const Product& product);

// The same in figures: `stages` (a list, one object each with its `stage`), `declared_priors` and
// `standard_accuracy`.
void add_paper_stages(nlohmann::ordered_json& json, const Product& product);

}  // namespace plumbline::deliver
