// SPDX-License-Identifier: MIT
#include "edge/orient/blunders.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plumbline::orient {
namespace {

constexpr double kMedianOfChiSquare2 = 1.3863;  // 2 ln 2
constexpr double kLeastSigmaPx = 1e-3;          // noise-free input must not divide by zero
constexpr double kStationChiSquare3 = 16.27;    // 0.1 %
constexpr double kLeastRedundancy = 0.02;
constexpr double kStationCauchySigmas = 3;
constexpr double kWildHeight = 0.4;  // of the flying height, above or below the ground

constexpr ImageGroup kEstimated[] = {ImageGroup::kTies, ImageGroup::kPicks};

void rescale(Network& network, ImageGroup group, double factor) {
  for (Ray& ray : network.rays) {
    if (ray.group == group) ray.sigma_px = std::max(ray.sigma_px * factor, kLeastSigmaPx);
  }
}

double squared_sigmas(const Ray& ray, const State& state) {
  const auto residual = residual_of(ray, state);
  if (!residual) return std::numeric_limits<double>::infinity();
  return residual->squaredNorm() / (ray.sigma_px * ray.sigma_px);
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Where a ray meets the horizontal plane z = height.
std::optional<Eigen::Vector3d> on_plane(const Ray& ray, const State& state, double height) {
  const geometry::Pose& pose = state.poses[at(ray.slot)];
  const auto direction = geometry::ray_in_photo(state.interior, ray.pixel);
  if (!direction) return std::nullopt;
  const Eigen::Vector3d in_ground = pose.ground_from_photo * *direction;
  if (!(in_ground.z() < 0)) return std::nullopt;
  return pose.centre_m + in_ground * ((height - pose.centre_m.z()) / in_ground.z());
}

// Of the two coordinates of a ray, the share that is not spent on unknowns, on average.
double mean_redundancy(const Network& network) {
  int rays = 0, points = 0;
  for (int p = 0; p < network.points(); ++p) {
    const int used = used_rays(network, p);
    rays += used;
    points += used > 0 ? 1 : 0;
  }
  const double unknowns = 3.0 * points + 1.0 * network.layout.columns();
  return std::clamp(1 - unknowns / std::max(1.0, 2.0 * rays), 0.1, 1.0);
}

bool holds_with_one_ray(const Network& network, int point) {
  return std::any_of(network.problem->control.begin(), network.problem->control.end(),
                     [&](const Control& c) { return c.point == point; });
}

// A point that lost rays must keep three, and more than half: two rays always meet somewhere, and
// what meets by chance meets far from the ground.
bool holds_together(const Network& network, int point, std::ptrdiff_t good, int given) {
  if (network.undetermined[at(point)]) return false;
  if (holds_with_one_ray(network, point)) return good >= 1;
  return good >= 2 && (good == given || (good >= 3 && 2 * good > given));
}

// A point of a known length that has no rays has nothing else to hold it: it stands aside, and the
// length with it, until its rays come back.
void couple(Network& network, int point, bool measured) {
  const std::vector<int>& kept = network.layout.kept;
  const auto place = std::find(kept.begin(), kept.end(), point);
  if (place == kept.end()) return;
  const bool held = measured || holds_with_one_ray(network, point);
  network.layout.kept_of_point[at(point)] = held ? static_cast<int>(place - kept.begin()) : -1;
}

}  // namespace

std::string name_of(ImageGroup group) {
  switch (group) {
    case ImageGroup::kTies:
      return "ties";
    case ImageGroup::kPicks:
      return "picks";
    case ImageGroup::kStated:
      break;
  }
  return "stated";
}

void rescale_by_median(Network& network, const State& state) {
  const double redundancy = mean_redundancy(network);
  for (const ImageGroup group : kEstimated) {
    std::vector<double> squares;
    for (const Ray& ray : network.rays) {
      if (ray.used && ray.group == group) squares.push_back(squared_sigmas(ray, state));
    }
    if (squares.empty()) continue;
    const double middle = median(squares);
    if (!std::isfinite(middle)) continue;
    rescale(network, group, std::sqrt(middle / kMedianOfChiSquare2 / redundancy));
  }
}

GroupFits group_fits(const Network& network, const NetworkCovariance& covariance,
                     const std::vector<RayLinear>& rays, const std::vector<Term>& terms) {
  GroupFits fits;
  PointSpread spread;
  int spread_of = -1;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const int point = network.rays[k].point;
    if (!rays[k].active || !covariance.point(point).measured) continue;
    if (point != spread_of) spread = covariance.spread(point);
    spread_of = point;
    GroupFit& fit = fits[name_of(network.rays[k].group)];
    const Eigen::Matrix2d q =
        covariance.pixel_covariance(network, network.rays[k], rays[k], spread);
    const double sigma = network.rays[k].sigma_px;
    fit.squares += rays[k].residual.squaredNorm() / (sigma * sigma);
    fit.redundancy += 2 - q.trace() * rays[k].information;
    fit.observations += 2;
  }
  for (const Term& term : terms) {
    GroupFit& fit = fits[term.group];
    const Eigen::MatrixXd q = covariance.common()(term.columns, term.columns);
    const Eigen::MatrixXd spent = term.jacobian * q * term.jacobian.transpose() * term.information;
    // A parameter held fixed or left free is no observation.
    const auto count = (term.information.diagonal().array() > 0).count();
    fit.squares += term.residual.dot(term.information * term.residual);
    fit.redundancy += static_cast<double>(count) - spent.trace();
    fit.observations += static_cast<int>(count);
  }
  return fits;
}

double rescale_by_variance(Network& network, const GroupFits& fits) {
  double change = 0;
  for (const ImageGroup group : kEstimated) {
    const auto fit = fits.find(name_of(group));
    if (fit == fits.end() || fit->second.redundancy < 1) continue;
    const double factor = std::sqrt(fit->second.squares / fit->second.redundancy);
    rescale(network, group, factor);
    change = std::max(change, std::abs(factor - 1));
  }
  return change;
}

int reject_rays(Network& network, const State& state, double sigmas) {
  int changed = 0;
  for (int p = 0; p < network.points(); ++p) {
    const int first = network.first_ray[at(p)], last = network.first_ray[at(p) + 1];
    std::vector<bool> good;
    for (int k = first; k < last; ++k) {
      good.push_back(squared_sigmas(network.rays[at(k)], state) <= sigmas * sigmas);
    }
    const bool enough =
        holds_together(network, p, std::count(good.begin(), good.end(), true), last - first);
    for (int k = first; k < last; ++k) {
      const bool use = enough && good[at(k - first)];
      changed += use != network.rays[at(k)].used ? 1 : 0;
      network.rays[at(k)].used = use;
    }
    couple(network, p, enough);
  }
  return changed;
}

void replant_wild_points(const Network& network, State& state) {
  std::vector<double> heights, stations;
  for (int p = 0; p < network.points(); ++p) {
    if (used_rays(network, p) > 0) heights.push_back(state.points[at(p)].z());
  }
  for (const geometry::Pose& pose : state.poses) stations.push_back(pose.centre_m.z());
  if (heights.empty() || stations.empty()) return;
  const double ground = median(heights);
  const double limit = kWildHeight * std::abs(median(stations) - ground);
  for (int p = 0; p < network.points(); ++p) {
    Eigen::Vector3d& point = state.points[at(p)];
    if (std::abs(point.z() - ground) <= limit) continue;
    std::vector<double> east, north;
    for (int k = network.first_ray[at(p)]; k < network.first_ray[at(p) + 1]; ++k) {
      if (const auto foot = on_plane(network.rays[at(k)], state, ground)) {
        east.push_back(foot->x());
        north.push_back(foot->y());
      }
    }
    if (!east.empty()) point = {median(east), median(north), ground};
  }
}

int drop_undetermined(Network& network, const NormalEquations& equations, double limit_m) {
  int dropped = 0;
  for (int p = 0; p < network.points(); ++p) {
    const PointBlock& block = equations.points[at(p)];
    if (!block.active) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(block.v, Eigen::EigenvaluesOnly);
    if (modes.eigenvalues()[0] * limit_m * limit_m > 1) continue;
    network.undetermined[at(p)] = true;
    for (int k = network.first_ray[at(p)]; k < network.first_ray[at(p) + 1]; ++k) {
      network.rays[at(k)].used = false;
    }
    ++dropped;
  }
  return dropped;
}

void drop_unprojectable(Network& network, const State& state) {
  for (Ray& ray : network.rays) {
    if (ray.used && !residual_of(ray, state)) ray.used = false;
  }
}

std::vector<double> robust_station_weights(const Network& network, const State& state) {
  std::vector<double> weights(at(network.slots()), 1.0);
  const GnssErrorModel& model = network.problem->gnss;
  const Eigen::Vector3d common(
      std::hypot(model.offset_sigma_horizontal_m, model.correlated_sigma_horizontal_m),
      std::hypot(model.offset_sigma_horizontal_m, model.correlated_sigma_horizontal_m),
      std::hypot(model.offset_sigma_vertical_m, model.correlated_sigma_vertical_m));
  for (int slot = 0; slot < network.slots(); ++slot) {
    const auto& station = network.photo(slot).station;
    if (!station) continue;
    const geometry::Pose& pose = state.poses[at(slot)];
    const Eigen::Vector3d miss = pose.centre_m +
                                 pose.ground_from_photo * network.problem->lever_arm.in_photo_m -
                                 station->antenna_in_enu_m;
    Eigen::Matrix3d spread = station->covariance_m2 + 1e-8 * Eigen::Matrix3d::Identity();
    spread.diagonal() += common.cwiseAbs2();
    const double squared = miss.dot(spread.ldlt().solve(miss));
    weights[at(slot)] = 1 / (1 + squared / (kStationCauchySigmas * kStationCauchySigmas));
  }
  return weights;
}

int suspicious_station(const Network& network, const State& /*state*/, const TermOptions& options,
                       const std::vector<Term>& terms, const NetworkCovariance& covariance) {
  const std::vector<int> slots = station_slots(network, options);
  const auto term =
      std::find_if(terms.begin(), terms.end(), [](const Term& t) { return t.group == "gnss"; });
  if (term == terms.end() || slots.size() < 3) return -1;
  // A gross error of one station among correlated ones: with P the stations' information, v their
  // residuals and Q the residuals' covariance, it shows in P v, whose covariance is P Q P (Baarda
  // 1968). An error common to all of them so hides nothing of it.
  const Eigen::MatrixXd& p = term->information;
  const Eigen::MatrixXd adjusted = term->jacobian *
                                   covariance.common()(term->columns, term->columns) *
                                   term->jacobian.transpose();
  const Eigen::MatrixXd spread = p - p * adjusted * p;
  const Eigen::VectorXd weighted = p * term->residual;
  int worst = -1;
  double most = kStationChiSquare3;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(3 * k);
    const Eigen::Matrix3d own = p.block<3, 3>(row, row);
    const Eigen::Matrix3d of_weighted = spread.block<3, 3>(row, row);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> modes(of_weighted, own);
    const Eigen::Vector3d v = modes.eigenvectors().transpose() * weighted.segment<3>(row);
    double statistic = 0;
    for (int i = 0; i < 3; ++i) {
      if (modes.eigenvalues()[i] > kLeastRedundancy)
        statistic += v[i] * v[i] / modes.eigenvalues()[i];
    }
    if (statistic <= most) continue;
    most = statistic;
    worst = slots[k];
  }
  return worst;
}

}  // namespace plumbline::orient
