// SPDX-License-Identifier: MIT
#include "edge/survey/check_points.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "edge/base/chi_square.h"

namespace plumbline::survey {
namespace {

// A known point and the measured one of the same name.
struct Match {
  const CheckPoint* known;
  int point;
};

std::set<std::string> control_names(const orient::Problem& problem) {
  std::set<std::string> names;
  for (const orient::Control& control : problem.control)
    names.insert(problem.point_names[static_cast<std::size_t>(control.point)]);
  return names;
}

std::map<std::string, int> measured_points(const orient::Problem& problem,
                                           const orient::Solution& solution) {
  std::map<std::string, int> index_of;
  for (std::size_t i = 0; i < solution.points.size(); ++i)
    if (solution.points[i].measured) index_of[problem.point_names[i]] = static_cast<int>(i);
  return index_of;
}

std::vector<Match> match_by_name(const orient::Problem& problem, const orient::Solution& solution,
                                 const std::vector<CheckPoint>& known, CheckReport& report) {
  const std::map<std::string, int> index_of = measured_points(problem, solution);
  const std::set<std::string> control = control_names(problem);
  std::vector<Match> matches;
  for (const CheckPoint& point : known) {
    const auto found = index_of.find(point.point);
    if (control.contains(point.point))
      report.also_control.push_back(point.point);
    else if (found == index_of.end())
      report.not_measured.push_back(point.point);
    else
      matches.push_back({&point, found->second});
  }
  return matches;
}

bool tied_to_the_frame(const orient::Problem& problem) {
  return !problem.control.empty() ||
         std::any_of(problem.photos.begin(), problem.photos.end(),
                     [](const orient::Photo& photo) { return photo.station.has_value(); });
}

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(3 * i); }

Eigen::VectorXd differences(const orient::Solution& solution, const std::vector<Match>& matches) {
  Eigen::VectorXd d(at(matches.size()));
  for (std::size_t i = 0; i < matches.size(); ++i)
    d.segment<3>(at(i)) = solution.points[static_cast<std::size_t>(matches[i].point)].in_enu_m -
                          matches[i].known->in_enu_m;
  return d;
}

// Of the differences; without the solution's joint covariance, of each point by itself.
Eigen::MatrixXd covariance(const orient::Solution& solution, const std::vector<Match>& matches) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(at(matches.size()), at(matches.size()));
  if (solution.covariances) {
    std::vector<int> indices;
    for (const Match& match : matches) indices.push_back(match.point);
    c = solution.covariances->joint(indices);
  } else {
    for (std::size_t i = 0; i < matches.size(); ++i)
      c.block<3, 3>(at(i), at(i)) =
          solution.points[static_cast<std::size_t>(matches[i].point)].covariance_m2;
  }
  for (std::size_t i = 0; i < matches.size(); ++i)
    c.diagonal().segment<3>(at(i)) += matches[i].known->sigma_m.cwiseAbs2();
  return c;
}

void fill_moments(const Eigen::VectorXd& d, const Eigen::VectorXd& sigma, CheckReport& report) {
  const Eigen::Index points = d.size() / 3;
  const auto n = static_cast<double>(points);
  int within_one = 0;
  int within_two = 0;
  int uncertain = 0;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    report.rmse_m[i % 3] += d[i] * d[i] / n;
    report.rms_stated_sigma_m[i % 3] += sigma[i] * sigma[i] / n;
    if (!(sigma[i] > 0)) continue;  // zero by the definition of a local frame
    ++uncertain;
    if (std::abs(d[i]) <= sigma[i]) ++within_one;
    if (std::abs(d[i]) <= 2.0 * sigma[i]) ++within_two;
  }
  report.rmse_m = report.rmse_m.cwiseSqrt().eval();
  report.rms_stated_sigma_m = report.rms_stated_sigma_m.cwiseSqrt().eval();
  report.largest_m = d.cwiseAbs().maxCoeff();
  report.share_within_one_sigma = within_one / std::max(1.0, static_cast<double>(uncertain));
  report.share_within_two_sigma = within_two / std::max(1.0, static_cast<double>(uncertain));
}

// Coordinates and directions in which the covariance vanishes (a frame held by some of the points)
// say nothing and are left out of the sum and of the degrees of freedom.
void fill_joint_nees(const Eigen::VectorXd& all_d, const Eigen::MatrixXd& all_c,
                     CheckReport& report) {
  std::vector<Eigen::Index> uncertain;
  for (Eigen::Index i = 0; i < all_d.size(); ++i)
    if (!(all_c(i, i) <= 0)) uncertain.push_back(i);
  const Eigen::VectorXd d = all_d(uncertain);
  const Eigen::MatrixXd c = all_c(uncertain, uncertain);
  const Eigen::VectorXd sigma = c.diagonal().cwiseSqrt();
  if (uncertain.empty() || !c.allFinite()) return;
  const Eigen::VectorXd inverse = sigma.cwiseInverse();
  const Eigen::MatrixXd correlation = inverse.asDiagonal() * c * inverse.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(correlation);
  if (modes.info() != Eigen::Success) return;
  const Eigen::VectorXd along = modes.eigenvectors().transpose() * inverse.cwiseProduct(d);
  const double floor = 1e-12 * modes.eigenvalues().maxCoeff();
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    if (modes.eigenvalues()[i] <= floor) continue;
    report.joint_nees += along[i] * along[i] / modes.eigenvalues()[i];
    ++report.joint_nees_dof;
  }
  report.joint_nees_low = chi_square_quantile(0.005, report.joint_nees_dof);
  report.joint_nees_high = chi_square_quantile(0.995, report.joint_nees_dof);
}

double flat_rmse_m(const std::vector<Match>& matches) {
  double squares = 0;
  for (const Match& match : matches) squares += std::pow(match.known->in_enu_m.z(), 2);
  return std::sqrt(squares / static_cast<double>(matches.size()));
}

void fill_best_fit(const orient::Solution& solution, const std::vector<Match>& matches,
                   CheckReport& report) {
  if (matches.size() < 3) return;
  const auto n = static_cast<Eigen::Index>(matches.size());
  Eigen::Matrix3Xd measured(3, n);
  Eigen::Matrix3Xd known(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Match& match = matches[static_cast<std::size_t>(i)];
    measured.col(i) = solution.points[static_cast<std::size_t>(match.point)].in_enu_m;
    known.col(i) = match.known->in_enu_m;
  }
  const Eigen::Matrix4d fit = Eigen::umeyama(measured, known, true);
  if (!fit.allFinite()) return;  // all points in one place
  const Eigen::Matrix3Xd left =
      ((fit.topLeftCorner<3, 3>() * measured).colwise() + fit.topRightCorner<3, 1>()) - known;
  for (Eigen::Index i = 0; i < n; ++i)
    report.points[static_cast<std::size_t>(i)].best_fit_difference_m = left.col(i);
  report.best_fit_rmse_m = (left.rowwise().squaredNorm() / static_cast<double>(n)).cwiseSqrt();
}

// A turn by theta moves a point at radius r by r theta along its error bar and by r theta^2 / 2
// across it, where only its own, much smaller sigma stands.
bool turns_are_small(const orient::Solution& solution, const std::vector<Match>& matches) {
  const orient::CommonSigmas& common = solution.summary.common;
  const double turn_rad = std::hypot(common.azimuth_rad, common.tilt_rad);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double own = 0;
  const auto n = static_cast<double>(matches.size());
  for (const Match& match : matches) {
    const auto& point = solution.points[static_cast<std::size_t>(match.point)];
    centre += point.in_enu_m / n;
    own += point.local_covariance_m2.trace() / 3 / n;
  }
  double radius = 0;
  for (const Match& match : matches) {
    const auto& point = solution.points[static_cast<std::size_t>(match.point)];
    radius = std::max(radius, (point.in_enu_m - centre).norm());
  }
  return 0.5 * radius * turn_rad * turn_rad <= std::sqrt(own);
}

}  // namespace

Result<CheckReport> check(const orient::Problem& problem, const orient::Solution& solution,
                          const std::vector<CheckPoint>& known) {
  CheckReport report;
  const std::vector<Match> matches = match_by_name(problem, solution, known, report);
  if (matches.empty())
    return Error{
        "None of the " + std::to_string(known.size()) +
        " check points was measured independently; name them as in the picks (or observations), "
        "and do not use the same points as control."};
  const Eigen::VectorXd d = differences(solution, matches);
  const Eigen::MatrixXd c = covariance(solution, matches);
  const Eigen::VectorXd sigma = c.diagonal().cwiseSqrt();
  for (std::size_t i = 0; i < matches.size(); ++i)
    report.points.push_back({matches[i].known->point, d.segment<3>(at(i)), sigma.segment<3>(at(i)),
                             Eigen::Vector3d::Zero()});
  report.same_frame = solution.frame.has_value() || tied_to_the_frame(problem);
  if (solution.frame) report.flat_rmse_u_m = flat_rmse_m(matches);
  fill_moments(d, sigma, report);
  if (solution.covariances) fill_joint_nees(d, c, report);
  report.joint_nees_holds = turns_are_small(solution, matches);
  fill_best_fit(solution, matches, report);
  return report;
}

}  // namespace plumbline::survey
