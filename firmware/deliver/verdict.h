// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// The result in words.
struct Verdict {
  enum class Level { kGood, kCaution, kBad };
  Level level = Level::kGood;
  std::string headline;                // one sentence
  std::vector<std::string> sentences;  // what stands behind it
};
Verdict verdict(const Product& product);

// What the comparison with known points says, in words: shares, joint test, best fit, the largest.
std::vector<std::string> check_sentences(const survey::CheckReport& check);

// Of the solution, then of the product.
std::vector<std::string> all_warnings(const Product& product);

}  // namespace plumbline::deliver
