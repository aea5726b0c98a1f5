// SPDX-License-Identifier: MIT
#include "edge/orient/precision/point_twists.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

namespace plumbline::orient {
namespace {

// No further along the weak direction: a turn of more is no small one.
constexpr double kLargestTurnRad = 0.5;
// Of the variance of a point's own errors, the mean share below which a twist is left out.
constexpr double kLeastShare = 1e-3;

class Twists {
 public:
  Twists(const Network& network, const State& state, const NetworkCovariance& covariance,
         const Step& one_sigma, double sigma_rad)
      : covariance_(covariance), share_(std::min(1.0, kLargestTurnRad / sigma_rad)) {
    const auto factors_at = [&](double by) {
      const State there = moved_by(network, state, scaled(one_sigma, by));
      return point_factors(network, normal_equations(network, there, 0, {}));
    };
    ahead_ = factors_at(share_);
    behind_ = factors_at(-share_);
  }

  // 3 x others: the twists of a point; `moved` (columns x others) is a sigma of each of the others.
  Eigen::Matrix3Xd of_point(std::size_t p, const Eigen::MatrixXd& moved) const {
    return (ahead_[p].by_common - behind_[p].by_common) / (2 * share_) *
           moved(ahead_[p].columns, Eigen::all);
  }
  bool defined(std::size_t p) const {
    return covariance_.point(static_cast<int>(p)).measured && ahead_[p].measured &&
           behind_[p].measured;
  }

  // Of each of the others: the mean of d' own^-1 d over the points.
  Eigen::VectorXd shares(const Eigen::MatrixXd& moved) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(moved.cols());
    int points = 0;
    for (std::size_t p = 0; p < ahead_.size(); ++p) {
      if (!defined(p)) continue;
      const Eigen::LLT<Eigen::Matrix3d> own(covariance_.point(static_cast<int>(p)).own);
      if (own.info() != Eigen::Success) continue;
      sum += own.matrixL().solve(of_point(p, moved)).colwise().squaredNorm();
      ++points;
    }
    return sum / std::max(points, 1);
  }

  std::vector<Step> steps(const Eigen::MatrixXd& moved) const {
    const Step none{Eigen::VectorXd::Zero(moved.rows()),
                    std::vector<Eigen::Vector3d>(ahead_.size(), Eigen::Vector3d::Zero())};
    std::vector<Step> out(static_cast<std::size_t>(moved.cols()), none);
    for (std::size_t p = 0; p < ahead_.size(); ++p) {
      if (!defined(p)) continue;
      const Eigen::Matrix3Xd twists = of_point(p, moved);
      for (std::size_t k = 0; k < out.size(); ++k)
        out[k].points[p] = twists.col(static_cast<Eigen::Index>(k));
    }
    return out;
  }

 private:
  const NetworkCovariance& covariance_;
  double share_;
  std::vector<PointFactor> ahead_, behind_;
};

}  // namespace

std::vector<Step> point_twists(const Network& network, const State& state,
                               const NetworkCovariance& covariance, const Step& one_sigma,
                               double sigma_rad, const std::vector<WeakDirection>& others) {
  const Twists twists(network, state, covariance, one_sigma, sigma_rad);
  const Eigen::Index columns = covariance.common().rows();
  Eigen::MatrixXd moved(columns, static_cast<Eigen::Index>(others.size()));
  Eigen::Index known = 0;
  for (const WeakDirection& other : others) {
    if (other.sigma_rad > 0)
      moved.col(known++) = covariance.common() * other.gradient / other.sigma_rad;
  }
  const Eigen::VectorXd shares = twists.shares(moved.leftCols(known));
  std::vector<Eigen::Index> worth_it;
  for (Eigen::Index k = 0; k < known; ++k) {
    if (shares[k] > kLeastShare) worth_it.push_back(k);
  }
  return twists.steps(moved(Eigen::all, worth_it));
}

}  // namespace plumbline::orient
