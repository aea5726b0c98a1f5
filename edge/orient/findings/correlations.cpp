// SPDX-License-Identifier: MIT
#include "edge/orient/findings/correlations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "edge/orient/precision/weak_directions.h"

namespace plumbline::orient {
namespace {

constexpr double kGoesWith = 0.5;
constexpr std::size_t kMostCombinations = 3;
constexpr std::size_t kMostCorrelations = 20;
constexpr int kSimilarity = 7;

constexpr std::array<const char*, kSimilarity> kShape = {
    "east", "north", "height", "tilt_east", "tilt_north", "azimuth", "scale"};
constexpr int kHeight = 2, kAzimuth = 5, kScale = 6;

// Quantities as linear combinations of the reduced columns and of the similarity of the points.
struct Quantities {
  std::vector<std::string> names;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd with_columns;  // columns x quantities
};

class Collector {
 public:
  explicit Collector(const Evidence& e) : e_(e), columns_(e.network.layout.columns()) {
    const Eigen::MatrixXd& with = e.frame.with_columns;
    joint_.resize(columns_ + kSimilarity, columns_ + kSimilarity);
    joint_ << e.covariance.common().topLeftCorner(columns_, columns_), with.topRows(columns_),
        with.topRows(columns_).transpose(), e.frame.common_covariance;
  }

  Quantities all() {
    for (int i = 0; i < geometry::kInteriorCount; ++i) {
      if (e_.network.shared_mask[i] != 0) add(geometry::kInteriorNames[at(i)], unit(i));
    }
    add_shape();
    Quantities out;
    out.names = std::move(names_);
    Eigen::MatrixXd by(joint_.rows(), static_cast<Eigen::Index>(rows_.size()));
    for (std::size_t k = 0; k < rows_.size(); ++k) by.col(static_cast<Eigen::Index>(k)) = rows_[k];
    const Eigen::MatrixXd with = joint_ * by;
    out.covariance = by.transpose() * with;
    out.with_columns = with.topRows(columns_);
    return out;
  }

 private:
  void add_shape() {
    const DatumDefect defect = datum_defect(e_.network, e_.terms);
    Eigen::VectorXd above = -unit(columns_ + kHeight);
    for (int slot = 0; slot < e_.network.slots(); ++slot)
      above[e_.network.layout.photo(slot) + 2] += 1.0 / e_.network.slots();
    if (!defect.scale) add("flying_height", above);
    for (int k = 0; k < kSimilarity; ++k) {
      const bool unknown = (k <= kHeight && defect.translation) ||
                           (k == kAzimuth && defect.azimuth) || (k == kScale && defect.scale);
      if (!unknown) add(kShape[at(k)], unit(columns_ + k));
    }
  }
  void add(const char* name, Eigen::VectorXd row) {
    names_.emplace_back(name);
    rows_.push_back(std::move(row));
  }
  Eigen::VectorXd unit(int place) const { return Eigen::VectorXd::Unit(joint_.rows(), place); }

  const Evidence& e_;
  int columns_ = 0;
  Eigen::MatrixXd joint_;
  std::vector<std::string> names_;
  std::vector<Eigen::VectorXd> rows_;
};

double correlation(double covariance, double variance_a, double variance_b) {
  const double product = variance_a * variance_b;
  return product > 0 ? std::clamp(covariance / std::sqrt(product), -1.0, 1.0) : 0;
}

}  // namespace

std::vector<Correlation> correlations(const Evidence& evidence, double least) {
  std::vector<Correlation> out;
  if (!evidence.frame.determined) return out;
  const Quantities q = Collector(evidence).all();
  for (Eigen::Index a = 0; a < q.covariance.rows(); ++a) {
    for (Eigen::Index b = a + 1; b < q.covariance.cols(); ++b) {
      const double value = correlation(q.covariance(a, b), q.covariance(a, a), q.covariance(b, b));
      if (std::abs(value) > least)
        out.push_back(
            {q.names[static_cast<std::size_t>(a)], q.names[static_cast<std::size_t>(b)], value});
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Correlation& a, const Correlation& b) {
    return std::abs(a.value) > std::abs(b.value);
  });
  if (out.size() > kMostCorrelations) out.resize(kMostCorrelations);
  return out;
}

std::vector<WeakCombination> weakest_combinations(const Evidence& evidence) {
  std::vector<WeakCombination> out;
  if (!evidence.frame.determined) return out;
  const Quantities q = Collector(evidence).all();
  const int columns = evidence.network.layout.columns();
  const Eigen::MatrixXd common = evidence.covariance.common().topLeftCorner(columns, columns);
  for (const auto& [gradient, sigma] : weak_directions(evidence.network, evidence.state, common)) {
    if (out.size() == kMostCombinations || !(sigma > 0)) break;
    WeakCombination combination{sigma, {}};
    const Eigen::VectorXd with = q.with_columns.transpose() * gradient;
    for (Eigen::Index k = 0; k < with.size(); ++k) {
      const double value = correlation(with[k], sigma * sigma, q.covariance(k, k));
      if (std::abs(value) > kGoesWith)
        combination.goes_with.emplace_back(q.names[static_cast<std::size_t>(k)], value);
    }
    out.push_back(std::move(combination));
  }
  return out;
}

}  // namespace plumbline::orient
