// SPDX-License-Identifier: MIT
#pragma once

#include <proj.h>

#include <string>

namespace plumbline::geodesy {

// A transformation of PROJ between two coordinate systems, axes in the order of their authority.
class ProjTransform {
 public:
  ProjTransform(const std::string& from, const std::string& to)
      : context_(proj_context_create()),
        transform_(proj_create_crs_to_crs(context_, from.c_str(), to.c_str(), nullptr)) {}
  // A pipeline, angles in radians.
  explicit ProjTransform(const std::string& pipeline)
      : context_(proj_context_create()), transform_(proj_create(context_, pipeline.c_str())) {}
  ~ProjTransform() {
    proj_destroy(transform_);
    proj_context_destroy(context_);
  }
  ProjTransform(const ProjTransform&) = delete;
  ProjTransform& operator=(const ProjTransform&) = delete;

  bool ok() const { return transform_ != nullptr; }
  PJ_COORD operator()(double a, double b, double c = 0) const {
    return proj_trans(transform_, PJ_FWD, proj_coord(a, b, c, 0));
  }

 private:
  PJ_CONTEXT* context_;
  PJ* transform_;
};

}  // namespace plumbline::geodesy
