// SPDX-License-Identifier: MIT
#include "edge/orient/network/network.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "edge/base/median.h"

namespace plumbline::orient {
namespace {

// A priori sigma of a group whose sigma nobody stated, until its variance is estimated.
constexpr double kFirstGuessTiesPx = 0.5;
constexpr double kFirstGuessPicksPx = 1.0;

// The velocity of the camera is taken as that of the antenna.
Eigen::Vector3d centre_by_line_time(const Problem& problem, const Observation& o) {
  const auto& velocity = problem.photos[at(o.photo)].velocity_in_enu_m_s;
  if (!velocity) return Eigen::Vector3d::Zero();
  return *velocity * (o.pixel.y() - (problem.camera.height_px - 1) / 2.0);
}

void collect_rays(Network& network) {
  const Problem& problem = *network.problem;
  for (std::size_t k = 0; k < problem.observations.size(); ++k) {
    const Observation& o = problem.observations[k];
    const int slot = network.slot_of_photo[static_cast<std::size_t>(o.photo)];
    if (slot < 0) continue;
    network.rays.push_back({slot, o.point, o.pixel, first_sigma(o), o.group, static_cast<int>(k),
                            true, centre_by_line_time(problem, o)});
  }
  std::stable_sort(network.rays.begin(), network.rays.end(), [](const Ray& a, const Ray& b) {
    return std::tie(a.point, a.slot) < std::tie(b.point, b.slot);
  });
  network.first_ray.assign(problem.point_names.size() + 1, 0);
  for (const Ray& ray : network.rays) ++network.first_ray[static_cast<std::size_t>(ray.point) + 1];
  for (std::size_t p = 1; p < network.first_ray.size(); ++p) {
    network.first_ray[p] += network.first_ray[p - 1];
  }
}

void keep_coupled_points(Network& network) {
  const Problem& problem = *network.problem;
  Layout& layout = network.layout;
  layout.kept_of_point.assign(problem.point_names.size(), -1);
  const auto keep = [&](int point) {
    int& index = layout.kept_of_point[static_cast<std::size_t>(point)];
    if (index >= 0 || used_rays(network, point) == 0) return;
    index = static_cast<int>(layout.kept.size());
    layout.kept.push_back(point);
  };
  for (const Length& length : problem.lengths) {
    keep(length.point_a);
    keep(length.point_b);
  }
  for (const Control& control : problem.control) keep(control.point);
}

void group_points(Network& network) {
  std::map<std::pair<bool, std::vector<int>>, std::vector<int>> by_photos;
  for (int p = 0; p < network.points(); ++p) {
    std::vector<int> slots;
    for (int k = network.first_ray[at(p)]; k < network.first_ray[at(p) + 1]; ++k) {
      slots.push_back(network.rays[at(k)].slot);
    }
    const bool kept = network.layout.kept_of_point[at(p)] >= 0;
    if (!slots.empty()) by_photos[{kept, std::move(slots)}].push_back(p);
  }
  for (auto& [key, points] : by_photos) {
    network.groups.push_back({key.second, std::move(points), key.first});
  }
}

}  // namespace

double first_sigma(const Observation& o) {
  switch (o.group) {
    case ImageGroup::kTies:
      return o.sigma_px * kFirstGuessTiesPx;
    case ImageGroup::kPicks:
      return o.sigma_px * kFirstGuessPicksPx;
    case ImageGroup::kStated:
      break;
  }
  return o.sigma_px;
}

SharedVector shared_mask_of(const Problem& problem) {
  const geometry::Camera& camera = problem.camera;
  SharedVector spread;
  spread.head<geometry::kInteriorCount>() =
      camera.covariance ? geometry::InteriorVector(camera.covariance->diagonal()) : camera.sigma;
  spread[kLineTime] = camera.line_time_sigma_us;
  spread[kDelay] = problem.delay.sigma_s;
  return (spread.array() > 0).cast<double>();
}

Network make_network(const Problem& problem, std::vector<int> photo_of_slot) {
  Network network;
  network.problem = &problem;
  network.undetermined.assign(problem.point_names.size(), false);
  network.shared_mask = shared_mask_of(problem);
  network.photo_of_slot = std::move(photo_of_slot);
  network.slot_of_photo.assign(problem.photos.size(), -1);
  network.layout.slots = static_cast<int>(network.photo_of_slot.size());
  for (int slot = 0; slot < network.layout.slots; ++slot) {
    const int photo = network.photo_of_slot[static_cast<std::size_t>(slot)];
    network.slot_of_photo[static_cast<std::size_t>(photo)] = slot;
  }
  collect_rays(network);
  keep_coupled_points(network);
  group_points(network);
  return network;
}

int used_rays(const Network& network, int point) {
  const auto p = static_cast<std::size_t>(point);
  const auto begin = network.rays.begin();
  return static_cast<int>(std::count_if(begin + network.first_ray[p],
                                        begin + network.first_ray[p + 1],
                                        [](const Ray& ray) { return ray.used; }));
}

double flying_height(const Network& network, const State& state) {
  std::vector<double> stations, ground;
  for (const geometry::Pose& pose : state.poses) stations.push_back(pose.centre_m.z());
  for (int p = 0; p < network.points(); ++p) {
    if (used_rays(network, p) >= 2) ground.push_back(state.points[at(p)].z());
  }
  return upper_median(std::move(stations)) - upper_median(std::move(ground));
}

}  // namespace plumbline::orient
