// SPDX-License-Identifier: MIT
#pragma once

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// A believable result without an adjustment behind it: five photos from 70 to 90 m and, if wanted,
// one 10 m aside; named points on a ring-like field, ties all over; point sigmas from the
// intersection of their rays plus a common shift, turn and scale.
struct SampleOptions {
  bool side_step = true;
  bool georeferenced = true;
  bool check = true;
  bool poor_gnss = false;       // metres instead of centimetres
  bool one_unoriented = false;  // the last photo
  int named = 39;
  int ties = 300;
};

Product sample_product(const SampleOptions& options = {});

}  // namespace plumbline::deliver
