// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "edge/base/units.h"
#include "firmware/ingest/case_files.h"
#include "firmware/ingest/table_reader.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

using Columns = std::array<const char*, 3>;
constexpr Columns kPosition = {"e_m", "n_m", "u_m"};
constexpr Columns kPositionSigma = {"sigma_e_m", "sigma_n_m", "sigma_u_m"};
constexpr Columns kPositionCovariance = {"cov_en_m2", "cov_eu_m2", "cov_nu_m2"};
constexpr Columns kVelocity = {"ve_m_s", "vn_m_s", "vu_m_s"};
constexpr Columns kAngles = {"omega_deg", "phi_deg", "kappa_deg"};
constexpr Columns kAngleSigma = {"sigma_omega_deg", "sigma_phi_deg", "sigma_kappa_deg"};

// A position is never better than this: weights must stay finite.
constexpr double kLeastSigmaM = 1e-4;
constexpr double kLeastSigmaRad = 1e-7;

// One row after another of photos.csv.
class CasePhotoReader {
 public:
  explicit CasePhotoReader(const CsvTable& table) : reader_(table) { reader_.require({"photo"}); }

  Result<orient::Photo> read(const CsvRow& row) {
    orient::Photo photo;
    photo.name = reader_.text(row, "photo");
    photo.station = station(row);
    photo.attitude = attitude(row);
    photo.heading = heading(row);
    photo.time_s = reader_.number_or_blank(row, "time_s");
    photo.velocity_in_enu_m_s = three(row, kVelocity);
    if (!reader_.error() && !seen_.insert(photo.name).second) {
      reader_.fail(row, "the photo " + in_quotes(photo.name) + " is there twice.");
    }
    if (reader_.error()) return *reader_.error();
    return photo;
  }

  std::vector<std::string> notices() const {
    std::vector<std::string> sentences = reader_.notices();
    for (std::size_t i = 0; i < 3; ++i) {
      if (angles_without_sigma_[i] == 0) continue;
      sentences.push_back("photos.csv: " + std::string(kAngles[i]) + " of " +
                          std::to_string(angles_without_sigma_[i]) +
                          (angles_without_sigma_[i] == 1 ? " photo" : " photos") +
                          " was not used: it has no " + kAngleSigma[i] + " to say how good it is.");
    }
    return sentences;
  }

 private:
  // All three or none.
  std::optional<Eigen::Vector3d> three(const CsvRow& row, const Columns& columns) {
    const auto a = reader_.number_or_blank(row, columns[0]);
    const auto b = reader_.number_or_blank(row, columns[1]);
    const auto c = reader_.number_or_blank(row, columns[2]);
    if (a && b && c) return Eigen::Vector3d(*a, *b, *c);
    if (a || b || c) {
      reader_.fail(row, "give all three of " + std::string(columns[0]) + ", " + columns[1] +
                            " and " + columns[2] + ", or none.");
    }
    return std::nullopt;
  }

  std::optional<Eigen::Vector3d> three_sigmas(const CsvRow& row, const Columns& columns) {
    const auto sigma = three(row, columns);
    if (sigma && sigma->minCoeff() < 0) {
      reader_.fail(row, "a standard deviation is negative; it is 0 or more.");
    }
    return sigma;
  }

  std::optional<orient::Station> station(const CsvRow& row) {
    const auto position = three(row, kPosition);
    const auto sigma = three_sigmas(row, kPositionSigma);
    const auto covariance = three(row, kPositionCovariance);
    if (!position) return std::nullopt;
    if (!sigma) {
      reader_.fail(row,
                   "the position has no sigma_e_m, sigma_n_m, sigma_u_m: say how good it is, "
                   "or leave the position blank.");
      return std::nullopt;
    }
    orient::Station station;
    station.antenna_in_enu_m = *position;
    station.covariance_m2 = sigma->cwiseMax(kLeastSigmaM).cwiseAbs2().asDiagonal();
    if (covariance) add_covariance(row, *covariance, station.covariance_m2);
    return station;
  }

  void add_covariance(const CsvRow& row, const Eigen::Vector3d& en_eu_nu, Eigen::Matrix3d& matrix) {
    matrix(0, 1) = matrix(1, 0) = en_eu_nu[0];
    matrix(0, 2) = matrix(2, 0) = en_eu_nu[1];
    matrix(1, 2) = matrix(2, 1) = en_eu_nu[2];
    const Eigen::Vector3d inverse_sigma = matrix.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::Matrix3d correlation =
        inverse_sigma.asDiagonal() * matrix * inverse_sigma.asDiagonal();
    if (!(correlation.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > 1e-9)) {
      reader_.fail(row,
                   "the covariances of the position do not fit its sigmas (a correlation of 1 "
                   "or beyond).");
    }
  }

  // Where an angle or its sigma is blank nothing is known of it.
  std::optional<orient::AttitudePrior> attitude(const CsvRow& row) {
    orient::AttitudePrior prior;
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto angle = reader_.number_or_blank(row, kAngles[i]);
      const auto sigma = reader_.sigma_or_blank(row, kAngleSigma[i]);
      const auto at = static_cast<Eigen::Index>(i);
      prior.sigma_rad[at] = std::numeric_limits<double>::infinity();
      if (sigma && !angle) reader_.fail(row, std::string(kAngles[i]) + " is blank, its sigma not.");
      if (angle && !sigma) ++angles_without_sigma_[i];
      if (!angle || !sigma) continue;
      prior.omega_phi_kappa_rad[at] = *angle * kRadPerDeg;
      prior.sigma_rad[at] = std::max(*sigma * kRadPerDeg, kLeastSigmaRad);
      any = true;
    }
    return any ? std::optional(prior) : std::nullopt;
  }

  std::optional<orient::HeadingPrior> heading(const CsvRow& row) {
    const auto heading_deg = reader_.number_or_blank(row, "heading_deg");
    const auto sigma_deg = reader_.sigma_or_blank(row, "sigma_heading_deg");
    if (!heading_deg) return std::nullopt;
    if (!sigma_deg) {
      reader_.fail(row, "heading_deg has no sigma_heading_deg: say how good it is.");
      return std::nullopt;
    }
    return orient::HeadingPrior{*heading_deg * kRadPerDeg,
                                std::max(*sigma_deg * kRadPerDeg, kLeastSigmaRad)};
  }

  TableReader reader_;
  std::set<std::string> seen_;
  std::array<int, 3> angles_without_sigma_{};
};

// To the last digit: a position that was filled in, not measured.
bool all_in_one_place(const std::vector<orient::Photo>& photos) {
  const orient::Photo* first = nullptr;
  int stations = 0;
  for (const orient::Photo& photo : photos) {
    if (!photo.station) continue;
    if (first == nullptr) first = &photo;
    if (photo.station->antenna_in_enu_m != first->station->antenna_in_enu_m) return false;
    ++stations;
  }
  return stations >= 2;
}

}  // namespace

Result<std::vector<orient::Photo>> case_photos(const CsvTable& table,
                                               std::vector<std::string>& notices) {
  CasePhotoReader reader(table);
  std::vector<orient::Photo> photos;
  for (const CsvRow& row : table.rows) {
    Result<orient::Photo> photo = reader.read(row);
    if (!photo) return photo.error();
    photos.push_back(*std::move(photo));
  }
  if (photos.empty()) return Error{table.name + ": there are no photos in it."};
  for (std::string& notice : reader.notices()) notices.push_back(std::move(notice));
  if (all_in_one_place(photos)) {
    notices.push_back(table.name +
                      ": all photos have one and the same position; give the position of each, or "
                      "leave it blank.");
  }
  return photos;
}

}  // namespace plumbline::ingest
