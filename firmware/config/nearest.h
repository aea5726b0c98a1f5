// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace plumbline::config {

// Of `known` the word that was most likely meant by `word`: the one with the fewest characters
// changed, added, left out or exchanged with their neighbour, if these are at most a third of the
// word's; or the one that it is the beginning of. Of equals the first. Time is linear in the length
// of `word`.
std::optional<std::string_view> nearest(std::string_view word,
                                        const std::vector<std::string_view>& known);

}  // namespace plumbline::config
