// SPDX-License-Identifier: MIT
#include "firmware/commands/number_check.h"

#include <limits>

#include "firmware/deliver/text.h"
#include "firmware/ingest/number.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::commands {
namespace {

CLI::Validator number_check(double least, double most, const std::string& wanted) {
  const auto fault = [least, most, wanted](const std::string& text) -> std::string {
    const auto value = ingest::parse_number(text);
    if (value && *value >= least && *value <= most) return {};
    return ingest::in_quotes(text) + " is not " + wanted;
  };
  return {fault, wanted.substr(wanted.find(' ') + 1)};
}

}  // namespace

CLI::Validator number_within(double least, double most) {
  return number_check(least, most,
                      "a number from " + deliver::plain(least) + " to " + deliver::plain(most));
}

CLI::Validator number_above_zero() {
  constexpr double kLeast = std::numeric_limits<double>::min();
  return number_check(kLeast, std::numeric_limits<double>::max(), "a number above 0");
}

}  // namespace plumbline::commands
