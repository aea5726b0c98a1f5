// SPDX-License-Identifier: MIT
#include "edge/orient/start/free_start.h"

#include <algorithm>
#include <complex>
#include <map>
#include <string>

#include "edge/base/median.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/network/rays.h"
#include "edge/orient/start/plane_similarity.h"

namespace plumbline::orient {
namespace {

// Relief, tilt and distortion move a point off the similarity by a few per cent of the picture.
constexpr double kToleranceOfWidth = 0.05;

struct View {
  int point = 0;
  PlanePoint position;
};

// A photo as if it looked straight down: foot = where it stands over the plane, height above it,
// kappa. A point z of its image lies on the plane at foot + height exp(i kappa) z.
struct LevelPhoto {
  bool known = false;
  std::complex<double> foot = 0;
  double height = kReferenceHeight;
  double kappa_rad = 0;

  std::complex<double> ground(PlanePoint z) const {
    return foot + height * std::polar(1.0, kappa_rad) * z;
  }
};

// What each photo sees, sorted by point; the lens distortion at the start is taken off.
std::vector<std::vector<View>> views_of(const Problem& problem) {
  std::vector<std::vector<View>> views(problem.photos.size());
  for (const Observation& o : problem.observations) {
    const auto ray = geometry::ray_in_photo(problem.camera.interior, o.pixel);
    if (ray) views[at(o.photo)].push_back({o.point, {ray->x(), ray->y()}});
  }
  for (auto& list : views) {
    std::stable_sort(list.begin(), list.end(),
                     [](const View& a, const View& b) { return a.point < b.point; });
  }
  return views;
}

std::vector<PlaneMatch> matches_of(const std::vector<View>& first,
                                   const std::vector<View>& second) {
  std::vector<PlaneMatch> matches;
  auto other = second.begin();
  for (const View& view : first) {
    while (other != second.end() && other->point < view.point) ++other;
    if (other == second.end()) break;
    if (other->point == view.point) matches.push_back({view.position, other->position});
  }
  return matches;
}

using PairTable = std::map<std::pair<int, int>, PlaneSimilarity>;

PairTable similar_pairs(const std::vector<std::vector<View>>& views, double tolerance) {
  PairTable pairs;
  const int photos = static_cast<int>(views.size());
  for (int i = 0; i < photos; ++i) {
    for (int j = 0; j < photos; ++j) {
      if (i == j) continue;
      const auto fit = fit_similarity(matches_of(views[at(i)], views[at(j)]), tolerance);
      if (fit) pairs[{i, j}] = *fit;
    }
  }
  return pairs;
}

// z_j = a z_i + b with z = (ground - foot) exp(-i kappa) / height of each photo.
LevelPhoto follow(const LevelPhoto& from, const PlaneSimilarity& to) {
  LevelPhoto photo;
  photo.known = true;
  photo.height = from.height / std::abs(to.a);
  photo.kappa_rad = from.kappa_rad - std::arg(to.a);
  photo.foot = from.foot - photo.height * std::polar(1.0, photo.kappa_rad) * to.b;
  return photo;
}

// Prim's tree by number of agreeing matches, from `root`.
std::vector<LevelPhoto> tree_from(int root, int photos, const PairTable& pairs) {
  std::vector<LevelPhoto> level(at(photos));
  level[at(root)].known = true;
  for (;;) {
    const auto* best = static_cast<const PairTable::value_type*>(nullptr);
    for (const auto& pair : pairs) {
      if (!level[at(pair.first.first)].known || level[at(pair.first.second)].known) continue;
      if (best == nullptr || pair.second.inliers > best->second.inliers) best = &pair;
    }
    if (best == nullptr) return level;
    level[at(best->first.second)] = follow(level[at(best->first.first)], best->second);
  }
}

int known_count(const std::vector<LevelPhoto>& level) {
  return static_cast<int>(
      std::count_if(level.begin(), level.end(), [](const LevelPhoto& p) { return p.known; }));
}

std::vector<LevelPhoto> largest_tree(int photos, const PairTable& pairs) {
  std::vector<LevelPhoto> best;
  for (int root = 0; root < photos; ++root) {
    if (!best.empty() && best[at(root)].known) continue;
    auto level = tree_from(root, photos, pairs);
    if (best.empty() || known_count(level) > known_count(best)) best = std::move(level);
  }
  return best;
}

// The median, not the mean: one wrong match among few must not drag the point away.
std::vector<Eigen::Vector3d> points_on_plane(const Problem& problem,
                                             const std::vector<std::vector<View>>& views,
                                             const std::vector<LevelPhoto>& level) {
  std::vector<std::vector<double>> east(problem.point_names.size()), north(east.size());
  for (std::size_t photo = 0; photo < views.size(); ++photo) {
    if (!level[photo].known) continue;
    for (const View& view : views[photo]) {
      const std::complex<double> ground = level[photo].ground(view.position);
      east[at(view.point)].push_back(ground.real());
      north[at(view.point)].push_back(ground.imag());
    }
  }
  std::vector<Eigen::Vector3d> points(east.size(), Eigen::Vector3d::Zero());
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!east[p].empty()) points[p] = {upper_median(east[p]), upper_median(north[p]), 0};
  }
  return points;
}

}  // namespace

Result<FreeStart> free_start(const Problem& problem) {
  const auto views = views_of(problem);
  const geometry::Camera& camera = problem.camera;
  const double tolerance =
      kToleranceOfWidth * camera.width_px / camera.interior[geometry::kFocalLength];
  const int photos = static_cast<int>(problem.photos.size());
  const auto level = largest_tree(photos, similar_pairs(views, tolerance));
  if (known_count(level) < 2) {
    return Error{"No two photos share " + std::to_string(kLeastMatches) +
                 " points that fit together, so nothing can be measured; photos of the same "
                 "ground from different heights are needed."};
  }
  FreeStart start;
  start.state.interior = camera.interior;
  start.state.points = points_on_plane(problem, views, level);
  for (int photo = 0; photo < photos; ++photo) {
    const LevelPhoto& p = level[at(photo)];
    if (!p.known) continue;
    start.photo_of_slot.push_back(photo);
    start.state.poses.push_back({{p.foot.real(), p.foot.imag(), p.height},
                                 geometry::ground_from_photo({0, 0, p.kappa_rad})});
  }
  return start;
}

}  // namespace plumbline::orient
