// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace plumbline::deliver {

// `value` with so many decimals, a point, no thousands marks and no "-0"; independent of the
// locale. Empty where the value is not finite: nothing that is unknown is ever written as a number.
std::string fixed(double value, int decimals);

// As fixed(), "unknown" in words where the value is not finite.
std::string fixed_or(double value, int decimals, const std::string& otherwise);

// With `digits` significant ones, in plain decimals: 0.00123, 45.1, 1230.
std::string significant(double value, int digits);

// As few decimals as say it to six: "5", "0.2", "3.7".
std::string plain(double value);

// For people: "33 mm" below 1 m (two significant digits), "2.93 m" above, "unknown".
std::string length_words(double metres);

// `text` as valid UTF-8: what is not becomes U+FFFD, control characters a blank.
std::string clean_utf8(std::string_view text);

// For the content and the attributes of HTML and of XML; clean_utf8 included.
std::string escaped(std::string_view text);

// "1 photo", "3 photos".
std::string counted(long long count, const std::string& one, const std::string& many);

}  // namespace plumbline::deliver
