// SPDX-License-Identifier: MIT
#include "tests/firmware/deliver/sample_product.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "edge/survey/check_points.h"

namespace plumbline::deliver {
namespace {

using Random = std::mt19937_64;
constexpr double kImageSigmaPx = 0.22;

struct CommonErrors {
  double position_m;
  double azimuth_rad;
  double scale;
};

CommonErrors common_errors(const SampleOptions& options) {
  if (options.poor_gnss) return {2.9, 0.055, 0.041};
  return {0.006, options.side_step ? 0.0007 : 0.25, 0.0003};
}

// Points correlated through the common shift, turn about the vertical and scale.
class SampleCovariances : public orient::PointCovariances {
 public:
  SampleCovariances(const orient::Solution& solution, CommonErrors common) : common_(common) {
    for (const auto& point : solution.points) {
      places_.push_back(point.in_enu_m);
      local_.push_back(point.local_covariance_m2);
    }
  }
  Eigen::MatrixXd joint(const std::vector<int>& points) const override {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd by(3 * n, 5);
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto index = static_cast<std::size_t>(points[static_cast<std::size_t>(i)]);
      by.block<3, 5>(3 * i, 0) = by_common(places_[index]);
      c.block<3, 3>(3 * i, 3 * i) = local_[index];
    }
    return c + by * by.transpose();
  }
  Eigen::MatrixXd with_photo(int /*photo*/, const std::vector<int>& points) const override {
    return Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(3 * points.size()));
  }

 private:
  Eigen::Matrix<double, 3, 5> by_common(const Eigen::Vector3d& place) const {
    Eigen::Matrix<double, 3, 5> by;
    by.leftCols<3>() = common_.position_m * Eigen::Matrix3d::Identity();
    by.col(3) = common_.azimuth_rad * Eigen::Vector3d(-place.y(), place.x(), 0);
    by.col(4) = common_.scale * place;
    return by;
  }
  CommonErrors common_;
  std::vector<Eigen::Vector3d> places_;
  std::vector<Eigen::Matrix3d> local_;
};

double normal(Random& random) { return std::normal_distribution<double>()(random); }
double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

geometry::Camera camera() {
  geometry::Camera made;
  made.name = "FC350";
  made.width_px = 4000;
  made.height_px = 2250;
  made.interior << 2125.4, 1999.1, 1125.0, 0, 0, -0.012, 0.004, 0, 0.0003, -0.0002;
  geometry::InteriorMatrix covariance = geometry::InteriorMatrix::Zero();
  covariance.diagonal() << 0.25, 0.22, 0.24, 0, 0, 4e-8, 6e-8, 0, 1e-9, 1e-9;
  covariance(0, 1) = covariance(1, 0) = 0.02;
  made.covariance = covariance;
  made.sigma = covariance.diagonal().cwiseSqrt();
  return made;
}

void add_photo(Product& product, const std::string& name, const Eigen::Vector3d& centre_m,
               const SampleOptions& options, Random& random) {
  const double station_sigma_m = options.poor_gnss ? 2.5 : 0.005;
  orient::Photo photo;
  photo.name = name;
  photo.station =
      orient::Station{centre_m, station_sigma_m * station_sigma_m *
                                    Eigen::Vector3d(1, 1, 4).asDiagonal().toDenseMatrix()};
  orient::OrientedPhoto oriented;
  oriented.oriented = true;
  oriented.pose.centre_m = centre_m;
  oriented.pose.ground_from_photo = geometry::ground_from_photo(
      {0.01 * normal(random), 0.01 * normal(random), 0.3 + 0.05 * normal(random)});
  oriented.covariance.diagonal() << 2e-5, 2e-5, 6e-5, 1e-8, 1e-8, 5e-7;
  oriented.sigma_omega_phi_kappa_rad = Eigen::Vector3d(1e-4, 1e-4, 7e-4);
  oriented.gnss_residual_m =
      station_sigma_m * Eigen::Vector3d(normal(random), normal(random), 2 * normal(random));
  product.problem.photos.push_back(photo);
  product.solution.photos.push_back(oriented);
}

void add_photos(Product& product, const SampleOptions& options, Random& random) {
  for (int i = 0; i < 5; ++i)
    add_photo(product, "DJI_000" + std::to_string(i + 1) + ".JPG",
              {13.6 + 0.17 * i, -0.6 - 0.33 * i, 70.0 + 5.0 * i}, options, random);
  if (options.side_step) add_photo(product, "DJI_0006.JPG", {23.9, 1.4, 89.8}, options, random);
  if (options.one_unoriented) product.solution.photos.back() = orient::OrientedPhoto{};
}

double relief_m(double east_m, double north_m) {
  return 1.4 * std::sin(east_m / 17.0) + 0.9 * std::cos(north_m / 11.0) - 0.3;
}

// Observes `point` in every photo that sees it; returns the information of its rays.
Eigen::Matrix3d observe(Product& product, int point, const Eigen::Vector3d& place,
                        orient::ImageGroup group, Random& random) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity() * 1e-6;
  orient::MeasuredPoint& measured = product.solution.points.back();
  for (std::size_t i = 0; i < product.solution.photos.size(); ++i) {
    const orient::OrientedPhoto& photo = product.solution.photos[i];
    if (!photo.oriented) continue;
    const Eigen::Matrix3d photo_from_ground = photo.pose.ground_from_photo.transpose();
    const auto seen = geometry::project_with_derivatives(
        product.solution.camera.interior, photo_from_ground * (place - photo.pose.centre_m));
    if (!seen || seen->pixel.x() < 10 || seen->pixel.x() > 3990 || seen->pixel.y() < 10 ||
        seen->pixel.y() > 2240)
      continue;
    const bool rejected = uniform(random, 0, 1) < 0.01;
    const Eigen::Vector2d noise =
        (rejected ? 9.0 : kImageSigmaPx) * Eigen::Vector2d(normal(random), normal(random));
    product.problem.observations.push_back(
        {static_cast<int>(i), point, seen->pixel + noise, 1.0, group});
    product.solution.residuals.push_back({noise, kImageSigmaPx, !rejected});
    if (rejected) {
      ++product.solution.summary.observations_rejected;
      continue;
    }
    const Eigen::Matrix<double, 2, 3> by_place = seen->by_point * photo_from_ground;
    information += by_place.transpose() * by_place / (kImageSigmaPx * kImageSigmaPx);
    ++measured.rays;
    measured.residual_rms_px += noise.squaredNorm() / 2;
  }
  return information;
}

void add_point(Product& product, const std::string& name, const Eigen::Vector3d& place,
               orient::ImageGroup group, Random& random) {
  product.solution.points.emplace_back();
  product.problem.point_names.push_back(name);
  const int index = static_cast<int>(product.problem.point_names.size()) - 1;
  const Eigen::Matrix3d information = observe(product, index, place, group, random);
  orient::MeasuredPoint& point = product.solution.points.back();
  if (point.rays < 2) {
    point = orient::MeasuredPoint{};
    return;
  }
  point.measured = true;
  point.residual_rms_px = std::sqrt(point.residual_rms_px / point.rays);
  point.local_covariance_m2 = information.inverse();
  const Eigen::Matrix3d factor = point.local_covariance_m2.llt().matrixL();
  point.in_enu_m = place + factor * Eigen::Vector3d(normal(random), normal(random), normal(random));
}

void add_points(Product& product, const SampleOptions& options, Random& random) {
  for (int i = 0; i < options.named; ++i) {
    const double turn = 2.399963 * i;
    const double radius_m = 4.6 * std::sqrt(i + 0.3);
    const double east_m = 13.9 + radius_m * std::cos(turn);
    const double north_m = -1.2 + 0.8 * radius_m * std::sin(turn);
    add_point(product, std::to_string(20 + i), {east_m, north_m, relief_m(east_m, north_m)},
              orient::ImageGroup::kPicks, random);
  }
  for (int i = 0; i < options.ties; ++i) {
    const double east_m = uniform(random, -42, 68);
    const double north_m = uniform(random, -30, 28);
    add_point(product, "T" + std::to_string(i + 1), {east_m, north_m, relief_m(east_m, north_m)},
              orient::ImageGroup::kTies, random);
  }
}

// The draw of the common errors is applied to all points alike; returns the truth of the named.
std::vector<survey::CheckPoint> finish_points(Product& product, const CommonErrors& common,
                                              Random& random) {
  const auto covariances = std::make_shared<SampleCovariances>(product.solution, common);
  const Eigen::Vector3d shift =
      common.position_m * Eigen::Vector3d(normal(random), normal(random), normal(random));
  const double turn_rad = common.azimuth_rad * normal(random);
  const double scale = common.scale * normal(random);
  std::vector<survey::CheckPoint> truth;
  for (std::size_t i = 0; i < product.solution.points.size(); ++i) {
    orient::MeasuredPoint& point = product.solution.points[i];
    if (!point.measured) continue;
    point.covariance_m2 = covariances->joint({static_cast<int>(i)});
    const Eigen::Vector3d place = point.in_enu_m;
    const Eigen::Matrix3d factor = point.local_covariance_m2.llt().matrixL();
    const Eigen::Vector3d own =
        factor * Eigen::Vector3d(normal(random), normal(random), normal(random));
    truth.push_back(
        {product.problem.point_names[i],
         place - own - shift - scale * place - turn_rad * Eigen::Vector3d(-place.y(), place.x(), 0),
         Eigen::Vector3d::Constant(0.002)});
  }
  product.solution.covariances = covariances;
  return truth;
}

void add_unobservable(Product& product, const SampleOptions& options) {
  auto& list = product.solution.summary.unobservable;
  if (!options.side_step)
    list.push_back({"azimuth",
                    "The turn about the line of stations is known to 14.3 degrees only: the "
                    "stations lie on a straight line. Fly 10 m aside at the top, give a heading, "
                    "or measure one control point away from the foot."});
  if (options.poor_gnss)
    list.push_back({"scale",
                    "Scale is known to 4.1 % only: it rests on GNSS positions good to 2.5 m over "
                    "a climb of 20 m. Give a known length, or fly with RTK."});
}

void add_summary(Product& product, const SampleOptions& options, const CommonErrors& common) {
  orient::Summary& summary = product.solution.summary;
  summary.converged = true;
  summary.iterations = 9;
  summary.sigma0 = 1.013;
  summary.sigma0_by_group = {{"gnss", 0.94}, {"picks", 1.0}, {"ties", 1.0}};
  summary.image_sigma_px = kImageSigmaPx;
  summary.redundancy = 2213;
  summary.reprojection_rms_px = 0.214;
  summary.flying_height_m = 80.6;
  summary.common = {common.azimuth_rad, 0.0004, common.scale, common.position_m, 0.0005, 0.0011};
  add_unobservable(product, options);
  if (options.poor_gnss) {
    product.problem.gnss.offset_sigma_horizontal_m = 3.0;
    summary.warnings.push_back(
        "The photos say nothing about the accuracy of their positions: 2.5 m is assumed.");
  }
}

void count_points(Product& product) {
  product.counts.photos_given = static_cast<int>(product.problem.photos.size());
  for (const auto& photo : product.solution.photos) product.counts.photos_used += photo.oriented;
  for (std::size_t i = 0; i < product.solution.points.size(); ++i) {
    const bool tie = product.problem.point_names[i][0] == 'T';
    product.counts.tie_points += tie && product.solution.points[i].rays >= 2;
    product.counts.tie_points_3plus += tie && product.solution.points[i].rays >= 3;
  }
}

}  // namespace

Product sample_product(const SampleOptions& options) {
  Random random(20);
  const CommonErrors common = common_errors(options);
  Product product;
  product.title = "Test field, climb of 20 November";
  product.solution.camera = camera();
  product.problem.camera = product.solution.camera;
  add_photos(product, options, random);
  add_points(product, options, random);
  std::vector<survey::CheckPoint> truth = finish_points(product, common, random);
  add_summary(product, options, common);
  count_points(product);
  truth.resize(std::min<std::size_t>(truth.size(), 13));
  if (options.check && options.named > 0)
    product.check = survey::check(product.problem, product.solution, truth).value();
  if (options.georeferenced) product.origin = GeoOrigin{36.1037, 140.0863, 67.4};
  product.input_sha256 = {
      {"DJI_0001.JPG", "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08"},
      {"picks.csv", "2c26b46b68ffc68ff99b453c1d30413413422d706483bfa0f98a5e886266e7ae"}};
  return product;
}

}  // namespace plumbline::deliver
