// SPDX-License-Identifier: MIT
#pragma once

#include "edge/geometry/camera.h"

namespace plumbline::geometry {

// The arithmetic of camera.h (D. C. Brown 1971), written once for a single point (T = double) and
// for points side by side (T = an Eigen array, one point in each entry).

// Ideal image-plane coordinates x = X / -Z (right), y = -Y / -Z (down), and what the lens makes
// of them.
template <typename T>
struct Distorted {
  T x, y, r2;
  T radial;          // 1 + k1 r2 + k2 r2^2 + k3 r2^3
  T x_bent, y_bent;  // distorted
};

template <typename T>
Distorted<T> distorted(const InteriorVector& c, const T& x, const T& y) {
  const double p1 = c[kTangential1], p2 = c[kTangential2];
  Distorted<T> d;
  d.x = x;
  d.y = y;
  const T xx = x * x, yy = y * y, xy2 = 2 * (x * y);
  d.r2 = xx + yy;
  d.radial = 1 + d.r2 * (c[kRadial1] + d.r2 * (c[kRadial2] + d.r2 * c[kRadial3]));
  d.x_bent = x * d.radial + p1 * xy2 + p2 * (d.r2 + 2 * xx);
  d.y_bent = y * d.radial + p1 * (d.r2 + 2 * yy) + p2 * xy2;
  return d;
}

// d (r radial(r2)) / dr: how fast the distorted radius grows with the ideal one.
template <typename T>
T radial_growth(const InteriorVector& c, const T& r2) {
  return 1 + r2 * (3 * c[kRadial1] + r2 * (5 * c[kRadial2] + r2 * (7 * c[kRadial3])));
}

template <typename T>
T pixel_u(const InteriorVector& c, const Distorted<T>& d) {
  return c[kPrincipalU] + c[kFocalLength] * (d.x_bent + c[kSkew] * d.y_bent);
}

template <typename T>
T pixel_v(const InteriorVector& c, const Distorted<T>& d) {
  return c[kPrincipalV] + (c[kFocalLength] * (1 + c[kAffinity])) * d.y_bent;
}

// The distorted coordinates by the ideal ones: [xx xy; xy yy], symmetric.
template <typename T>
struct DistortedByIdeal {
  T xx, xy, yy;
};

template <typename T>
DistortedByIdeal<T> distorted_by_ideal(const InteriorVector& c, const Distorted<T>& d) {
  const double p1 = c[kTangential1], p2 = c[kTangential2];
  const T slope = 2 * c[kRadial1] + d.r2 * (4 * c[kRadial2] + d.r2 * (6 * c[kRadial3]));
  const T slope_x = slope * d.x;
  DistortedByIdeal<T> by;
  by.xx = d.radial + slope_x * d.x + (2 * p1) * d.y + (6 * p2) * d.x;
  by.xy = slope_x * d.y + (2 * p1) * d.x + (2 * p2) * d.y;
  by.yy = d.radial + slope * (d.y * d.y) + (6 * p1) * d.y + (2 * p2) * d.x;
  return by;
}

// A derivative of a pixel (u, v).
template <typename T>
struct ByPixel {
  T u, v;
};

// d pixel / d interior times `scale`, one column after the other, into by[kInteriorCount].
template <typename T>
void pixel_by_interior(const InteriorVector& c, const Distorted<T>& d, const T& scale,
                       ByPixel<T>* by) {
  const T fu = c[kFocalLength] * scale;
  const T fv = (c[kFocalLength] * (1 + c[kAffinity])) * scale;
  const T bend_uv = 2 * (d.x * d.y), bend_u = d.r2 + 2 * (d.x * d.x),
          bend_v = d.r2 + 2 * (d.y * d.y);
  const T zero = 0 * scale;
  by[kFocalLength] = {(d.x_bent + c[kSkew] * d.y_bent) * scale,
                      (1 + c[kAffinity]) * (d.y_bent * scale)};
  by[kPrincipalU] = {scale, zero};
  by[kPrincipalV] = {zero, scale};
  by[kAffinity] = {zero, fu * d.y_bent};
  by[kSkew] = {fu * d.y_bent, zero};
  by[kRadial1] = {fu * ((d.x + c[kSkew] * d.y) * d.r2), fv * (d.y * d.r2)};
  by[kRadial2] = {by[kRadial1].u * d.r2, by[kRadial1].v * d.r2};
  by[kRadial3] = {by[kRadial2].u * d.r2, by[kRadial2].v * d.r2};
  by[kTangential1] = {fu * (bend_uv + c[kSkew] * bend_v), fv * bend_v};
  by[kTangential2] = {fu * (bend_u + c[kSkew] * bend_uv), fv * bend_uv};
}

// d pixel / d (X, Y, Z in the photo frame) times `scale`, into by[3].
template <typename T>
void pixel_by_point(const InteriorVector& c, const Distorted<T>& d, const T& inverse_depth,
                    const T& scale, ByPixel<T>* by) {
  const DistortedByIdeal<T> bent = distorted_by_ideal(c, d);
  const T fu = c[kFocalLength] * (scale * inverse_depth);
  const T fv = (1 + c[kAffinity]) * fu;
  const ByPixel<T> by_x{fu * (bent.xx + c[kSkew] * bent.xy), fv * bent.xy};
  const ByPixel<T> by_y{fu * (bent.xy + c[kSkew] * bent.yy), fv * bent.yy};
  by[0] = by_x;
  by[1] = {-by_y.u, -by_y.v};
  by[2] = {by_x.u * d.x + by_y.u * d.y, by_x.v * d.x + by_y.v * d.y};
}

}  // namespace plumbline::geometry
