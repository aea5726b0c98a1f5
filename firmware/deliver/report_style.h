// SPDX-License-Identifier: MIT
#pragma once

namespace plumbline::deliver {

// The look of the report: one column, for a screen and for A4. Of the figures too, whose elements
// carry the class names below.
extern const char* const kReportStyle;

}  // namespace plumbline::deliver
