// SPDX-License-Identifier: MIT
#include "edge/geodesy/local_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "tests/edge/geodesy/proj_transform.h"

namespace plumbline::geodesy {
namespace {

constexpr double kRad = M_PI / 180;

TEST(LocalFrame, AgreesWithProjsTopocentricCoordinates) {
  const Geodetic origin{35.3612345, 139.1312345, 120};
  const auto frame = LocalFrame::at(origin);
  ASSERT_TRUE(frame.ok());
  char pipeline[300];
  std::snprintf(pipeline, sizeof pipeline,
                "+proj=pipeline +step +proj=cart +ellps=WGS84 +step +proj=topocentric +ellps=WGS84 "
                "+lat_0=%.10f +lon_0=%.10f +h_0=%.4f",
                origin.latitude_deg, origin.longitude_deg, origin.height_ellipsoidal_m);
  const ProjTransform proj(pipeline);
  ASSERT_TRUE(proj.ok());
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Geodetic place{35.35 + 1e-5 * static_cast<double>(random() % 2000),
                         139.12 + 1e-5 * static_cast<double>(random() % 2000),
                         0.1 * static_cast<double>(random() % 3000)};
    const PJ_COORD theirs =
        proj(place.longitude_deg * kRad, place.latitude_deg * kRad, place.height_ellipsoidal_m);
    const Eigen::Vector3d ours = frame->enu_of(place);
    EXPECT_NEAR(ours.x(), theirs.enu.e, 1e-6);
    EXPECT_NEAR(ours.y(), theirs.enu.n, 1e-6);
    EXPECT_NEAR(ours.z(), theirs.enu.u, 1e-6);
    const Geodetic back = frame->geodetic_of(ours);
    EXPECT_NEAR(back.latitude_deg, place.latitude_deg, 1e-12);
    EXPECT_NEAR(back.longitude_deg, place.longitude_deg, 1e-12);
    EXPECT_NEAR(back.height_ellipsoidal_m, place.height_ellipsoidal_m, 1e-7);
  }
}

TEST(LocalFrame, FallsAwayFromTheEarthWithTheSquareOfTheDistance) {
  const auto frame = LocalFrame::at({36, 140, 0});
  const Eigen::Vector3d north_1km = frame->enu_of({36 + 1000 / 110959.0, 140, 0});
  EXPECT_NEAR(north_1km.z(), -1000.0 * 1000.0 / (2 * 6.358e6), 1e-3);
  EXPECT_NEAR(north_1km.y(), 1000, 0.5);
  EXPECT_NEAR(north_1km.x(), 0, 1e-9);
}

TEST(LocalFrame, TurnsVectorsOfTheNeighbourhoodByTheAngleBetweenTheVerticals) {
  const auto frame = LocalFrame::at({36, 140, 0});
  EXPECT_TRUE(frame->enu_from_enu_at({36, 140, 50}).isIdentity(1e-12));
  const Eigen::Matrix3d turn = frame->enu_from_enu_at({37, 140, 0});
  const Eigen::Vector3d their_up = turn.col(2);
  EXPECT_NEAR(their_up.y(), std::sin(1 * kRad), 1e-12);
  EXPECT_NEAR(their_up.z(), std::cos(1 * kRad), 1e-12);
  EXPECT_NEAR((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
}

TEST(LocalFrame, TurnsVectorsAsGeographicLibDoes) {
  const Geodetic origin{-33.86, 151.21, 58};
  const auto frame = LocalFrame::at(origin);
  const GeographicLib::LocalCartesian theirs(origin.latitude_deg, origin.longitude_deg,
                                             origin.height_ellipsoidal_m);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    const Geodetic place{90 * unit(random), 180 * unit(random), 5000 * unit(random)};
    std::vector<double> turn(9);
    double x = 0, y = 0, z = 0;
    theirs.Forward(place.latitude_deg, place.longitude_deg, place.height_ellipsoidal_m, x, y, z,
                   turn);
    const Eigen::Matrix3d ours = frame->enu_from_enu_at(place);
    for (int k = 0; k < 9; ++k) {
      EXPECT_NEAR(ours(k / 3, k % 3), turn[static_cast<std::size_t>(k)], 1e-14);
    }
  }
}

TEST(LocalFrame, RefusesWhatIsNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(LocalFrame::at({91, 0, 0}).ok());
  EXPECT_FALSE(LocalFrame::at({nan, 0, 0}).ok());
  EXPECT_FALSE(LocalFrame::at({0, nan, 0}).ok());
  EXPECT_FALSE(LocalFrame::at({0, 0, std::numeric_limits<double>::infinity()}).ok());
}

}  // namespace
}  // namespace plumbline::geodesy
