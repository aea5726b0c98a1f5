// SPDX-License-Identifier: MIT
#include "edge/orient/network/normal_equations.h"

#include <cmath>

namespace plumbline::orient {
namespace {

// Costs as much as a residual of so many sigmas.
constexpr double kUnprojectableSigmas = 1e5;

double robust_cost(double squared_sigmas, double cauchy_scale) {
  if (cauchy_scale == 0) return squared_sigmas;
  const double c2 = cauchy_scale * cauchy_scale;
  return c2 * std::log1p(squared_sigmas / c2);
}

// Robust weight times information, ray by ray.
Lanes weight_of(const SeenRays& rays, double cauchy_scale) {
  if (cauchy_scale == 0) return rays.information;
  const Lanes squared_sigmas = (rays.u * rays.u + rays.v * rays.v) * rays.information;
  return rays.information / (1 + squared_sigmas / (cauchy_scale * cauchy_scale));
}

double cost_of(const BundleRays& measured, const SeenRays& rays, double cauchy_scale) {
  const Lanes squared_sigmas = (rays.u * rays.u + rays.v * rays.v) * rays.information;
  double cost = 0;
  if (cauchy_scale == 0) {
    cost = squared_sigmas.sum();
  } else {
    for (const double square : squared_sigmas) cost += robust_cost(square, cauchy_scale);
  }
  const auto lost = (rays.hidden && measured.information > 0).count();
  if (lost == 0) return cost;
  return cost + static_cast<double>(lost) *
                    robust_cost(kUnprojectableSigmas * kUnprojectableSigmas, cauchy_scale);
}

// Calls visit(bundle, ray of the bundle, measured, seen) for every ray lane of the network.
template <typename Visit>
void for_each_ray(const Network& network, const Bundles& bundles, const State& state,
                  const Visit& visit) {
  for (const Bundle& bundle : bundles.bundles) {
    const Lanes3 points = points_of(bundle, state);
    const int rays = static_cast<int>(network.groups[at(bundle.group)].slots.size());
    for (int k = 0; k < rays; ++k) {
      const BundleRays& measured = bundles.rays[at(bundle.first_ray + k)];
      visit(bundle, k, measured, seen(network, measured, points, state));
    }
  }
}

// The adjusted ones among the shared columns that rays know of.
std::vector<int> shared_columns(const Network& network) {
  std::vector<int> columns;
  for (int i = 0; i < kDelay; ++i) {
    if (network.shared_mask[i] != 0) columns.push_back(i);
  }
  return columns;
}

void add_term(const Term& term, NormalEquations& out) {
  const Eigen::MatrixXd weighted = term.information * term.jacobian;
  const Eigen::MatrixXd n = term.jacobian.transpose() * weighted;
  const Eigen::VectorXd g = weighted.transpose() * term.residual;
  for (Eigen::Index i = 0; i < n.rows(); ++i) {
    const int row = term.columns[static_cast<std::size_t>(i)];
    out.gradient[row] += g[i];
    for (Eigen::Index j = 0; j < n.cols(); ++j) {
      const int column = term.columns[static_cast<std::size_t>(j)];
      if (column <= row) out.n(row, column) += n(i, j);
    }
  }
}

Lanes product(const PixelLanes& a, const PixelLanes& b) { return a.u * b.u + a.v * b.v; }

// Sums the rays into the equations, bundle by bundle. With J the derivatives of a ray by
// its columns (shared, pose), A by its point and r its residual, all weighted: N += J'J, E += J'A,
// V += A'A, gc += J'r, gp += A'r.
class Assembly {
 public:
  Assembly(const Network& network, const State& state, double cauchy_scale, NormalEquations& out)
      : network_(network),
        state_(state),
        cauchy_scale_(cauchy_scale),
        shared_(shared_columns(network)),
        of_slot_(at(network.slots()), Products::Zero()),
        out_(out) {}

  void run(const Bundles& bundles) {
    prepare(bundles);
    for (const Bundle& bundle : bundles.bundles) add_bundle(bundles, bundle);
    for (int slot = 0; slot < network_.slots(); ++slot) put_photo(slot);
  }

 private:
  // Of one photo's rays: (shared, pose, residual)' (shared, pose, residual), its lower triangle.
  static constexpr int kProducts = kRayColumns + 1;
  using Products = Eigen::Matrix<double, kProducts, kProducts>;

  int shared() const { return static_cast<int>(shared_.size()); }

  void prepare(const Bundles& bundles) {
    const int columns = network_.layout.columns();
    out_.n.setZero(columns, columns);
    out_.gradient.setZero(columns);
    out_.point_count = at(network_.points());
    out_.points.clear();
    out_.columns_of_group.resize(network_.groups.size());
    for (std::size_t g = 0; g < network_.groups.size(); ++g) {
      std::vector<int>& of_group = out_.columns_of_group[g];
      of_group = shared_;
      for (const int slot : network_.groups[g].slots) {
        for (int i = 0; i < Layout::kPose; ++i) of_group.push_back(network_.layout.photo(slot) + i);
      }
    }
    std::size_t rows = 0;
    for (const Bundle& b : bundles.bundles) rows += out_.columns_of_group[at(b.group)].size();
    out_.e.resize(rows);
  }

  void add_bundle(const Bundles& bundles, const Bundle& bundle) {
    const PointGroup& group = network_.groups[at(bundle.group)];
    PointLanes block{bundle.group, bundle.count, bundle.point, {}, {}, next_e_};
    block.v.fill(Lanes::Zero());
    block.gradient.fill(Lanes::Zero());
    Lanes3* e = &out_.e[next_e_];
    for (int i = 0; i < shared(); ++i) e[i].fill(Lanes::Zero());
    const Lanes3 points = points_of(bundle, state_);
    for (std::size_t k = 0; k < group.slots.size(); ++k) {
      const BundleRays& measured = bundles.rays[at(bundle.first_ray) + k];
      Lanes3* e_pose = e + shared() + Layout::kPose * static_cast<int>(k);
      add_rays(measured, seen(network_, measured, points, state_), block, e, e_pose);
    }
    if (group.kept) {
      put_kept(block, e);
      return;
    }
    out_.points.push_back(block);
    next_e_ += out_.columns_of_group[at(bundle.group)].size();
  }

  void add_rays(const BundleRays& measured, const SeenRays& rays, PointLanes& block, Lanes3* e,
                Lanes3* e_pose) {
    const Lanes scale = weight_of(rays, cauchy_scale_).sqrt();
    differentiate(network_, rays, measured, state_, scale, linear_);
    const PixelLanes residual{rays.u * scale, rays.v * scale};
    const auto& a = linear_.by_point;
    for (int i = 0, entry = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) {
        const Lanes w = product(a[at(i)], a[at(j)]);
        block.v[at(entry++)] += w;
        // Where the photo moves, the point moves the other way.
        e_pose[i][at(j)] = -w;
        e_pose[j][at(i)] = -w;
      }
      block.gradient[at(i)] += product(a[at(i)], residual);
    }
    for (std::size_t j = 0; j < 3; ++j) {
      for (int i = 3; i < Layout::kPose; ++i) {
        e_pose[i][j] = product(linear_.by_common[at(kShared + i)], a[j]);
      }
      for (int i = 0; i < shared(); ++i) {
        e[i][j] += product(linear_.by_common[at(shared_[at(i)])], a[j]);
      }
    }
    add_products(residual, of_slot_[at(measured.slot)]);
  }

  void add_products(const PixelLanes& residual, Products& to) const {
    std::array<const PixelLanes*, kProducts> columns{};
    int count = 0;
    for (const int i : shared_) columns[at(count++)] = &linear_.by_common[at(i)];
    for (int i = kShared; i < kRayColumns; ++i) columns[at(count++)] = &linear_.by_common[at(i)];
    columns[at(count++)] = &residual;
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j <= i; ++j) to(i, j) += product(*columns[at(i)], *columns[at(j)]).sum();
    }
  }

  void put_photo(int slot) {
    std::vector<int> columns = shared_;
    for (int i = 0; i < Layout::kPose; ++i) columns.push_back(network_.layout.photo(slot) + i);
    const Products& products = of_slot_[at(slot)];
    const int count = static_cast<int>(columns.size());
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j <= i; ++j) out_.n(columns[at(i)], columns[at(j)]) += products(i, j);
      out_.gradient[columns[at(i)]] += products(count, i);
    }
  }

  void put_kept(const PointLanes& block, const Lanes3* e) {
    const std::vector<int>& columns = out_.columns_of_group[at(block.group)];
    for (int lane = 0; lane < block.count; ++lane) {
      const int kept = network_.layout.kept_of_point[at(block.point[at(lane)])];
      if (kept < 0) continue;
      const int first = network_.layout.kept_point(kept);
      for (int i = 0, entry = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) out_.n(first + i, first + j) += block.v[at(entry++)][lane];
        out_.gradient[first + i] += block.gradient[at(i)][lane];
        for (std::size_t c = 0; c < columns.size(); ++c) {
          out_.n(first + i, columns[c]) += e[c][at(i)][lane];
        }
      }
    }
  }

  const Network& network_;
  const State& state_;
  double cauchy_scale_;
  std::vector<int> shared_;
  std::vector<Products> of_slot_;
  NormalEquations& out_;
  std::size_t next_e_ = 0;
  LinearRays linear_;
};

RayLinear ray_in_lane(const Network& network, const SeenRays& rays, const LinearRays& linear,
                      int lane) {
  RayLinear out;
  out.active = true;
  out.residual = {rays.u[lane], rays.v[lane]};
  for (int i = 0; i < kRayColumns; ++i) {
    const PixelLanes& by = linear.by_common[at(i)];
    const bool moves = i >= kShared || (network.shared_mask[i] != 0 && i != kDelay);
    out.by_common.col(i) << (moves ? by.u[lane] : 0), (moves ? by.v[lane] : 0);
  }
  for (int i = 0; i < 3; ++i) {
    out.by_point.col(i) << linear.by_point[at(i)].u[lane], linear.by_point[at(i)].v[lane];
  }
  return out;
}

}  // namespace

std::optional<Eigen::Vector2d> residual_of(const Ray& ray, const State& state) {
  const geometry::Pose& pose = state.poses[at(ray.slot)];
  const auto pixel =
      geometry::project(state.interior, pose.ground_from_photo.transpose() *
                                            (state.points[at(ray.point)] - state.centre_of(ray)));
  if (!pixel) return std::nullopt;
  return *pixel - ray.pixel;
}

RaysLinear linearise_rays(const Network& network, const State& state, double cauchy_scale) {
  RaysLinear out;
  out.rays.resize(network.rays.size());
  LinearRays linear;
  for_each_ray(network, bundles_of(network), state,
               [&](const Bundle& bundle, int k, const BundleRays& measured, const SeenRays& rays) {
                 out.cost += cost_of(measured, rays, cauchy_scale);
                 differentiate(network, rays, measured, state, Lanes::Ones(), linear);
                 const Lanes weight = weight_of(rays, cauchy_scale);
                 for (int lane = 0; lane < bundle.count; ++lane) {
                   if (!(weight[lane] > 0)) continue;
                   const int index = network.first_ray[at(bundle.point[at(lane)])] + k;
                   out.rays[at(index)] = ray_in_lane(network, rays, linear, lane);
                   out.rays[at(index)].information = weight[lane];
                 }
               });
  return out;
}

double cost_of(const Network& network, const Bundles& bundles, const State& state,
               double cauchy_scale) {
  double cost = 0;
  for_each_ray(network, bundles, state,
               [&](const Bundle&, int, const BundleRays& measured, const SeenRays& rays) {
                 cost += cost_of(measured, rays, cauchy_scale);
               });
  return cost;
}

void normal_equations(const Network& network, const Bundles& bundles, const State& state,
                      double cauchy_scale, const std::vector<Term>& terms, NormalEquations& out) {
  Assembly(network, state, cauchy_scale, out).run(bundles);
  for (const Term& term : terms) add_term(term, out);
}

NormalEquations normal_equations(const Network& network, const State& state, double cauchy_scale,
                                 const std::vector<Term>& terms) {
  NormalEquations out;
  normal_equations(network, bundles_of(network), state, cauchy_scale, terms, out);
  return out;
}

Eigen::Matrix3d normal_of(const PointLanes& points, int lane) {
  const auto& v = points.v;
  Eigen::Matrix3d out;
  out << v[0][lane], v[1][lane], v[3][lane], v[1][lane], v[2][lane], v[4][lane], v[3][lane],
      v[4][lane], v[5][lane];
  return out;
}

Eigen::Matrix<double, Eigen::Dynamic, 3> coupling_of(const NormalEquations& equations,
                                                     const PointLanes& points, int lane) {
  const auto rows = equations.columns_of_group[at(points.group)].size();
  Eigen::Matrix<double, Eigen::Dynamic, 3> out(static_cast<Eigen::Index>(rows), 3);
  for (std::size_t r = 0; r < rows; ++r) {
    const Lanes3& e = equations.e[points.first_e + r];
    out.row(static_cast<Eigen::Index>(r)) << e[0][lane], e[1][lane], e[2][lane];
  }
  return out;
}

}  // namespace plumbline::orient
