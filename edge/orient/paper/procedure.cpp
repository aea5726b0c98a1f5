// SPDX-License-Identifier: MIT
#include "edge/orient/paper/procedure.h"

#include <algorithm>

#include "edge/orient/paper/final_adjustment.h"
#include "edge/orient/paper/heights.h"
#include "edge/orient/paper/intersection.h"
#include "edge/orient/paper/relative.h"
#include "edge/orient/paper/scaled_model.h"
#include "edge/orient/validate.h"

namespace plumbline::orient::paper {
namespace {

// Every height is an unknown beside every photo here: more points are work for the adjustment that
// eliminates them.
constexpr std::size_t kMostPoints = 500;

Status check_case(const Problem& problem) {
  if (auto status = validate(problem); !status) return status;
  if (problem.lengths.empty()) {
    return Error{
        "The published procedure takes its scale from one known length: give it in "
        "lengths.csv (point_a,point_b,length_m)."};
  }
  if (problem.point_names.size() > kMostPoints) {
    return Error{"The published procedure is for targets measured by hand, at most " +
                 std::to_string(kMostPoints) + "; there are " +
                 std::to_string(problem.point_names.size()) +
                 " points. Use the rigorous adjustment (without --paper)."};
  }
  return Done{};
}

void add_standard_accuracy(Procedure& out) {
  const auto& poses = out.adjusted.poses;
  for (const geometry::Pose& a : poses) {
    out.mean_height_m += a.centre_m.z() / static_cast<double>(poses.size());
    for (const geometry::Pose& b : poses)
      out.longest_base_m = std::max(out.longest_base_m, (a.centre_m - b.centre_m).norm());
  }
  out.standard = geometry::standard_accuracy(out.mean_height_m, out.longest_base_m,
                                             out.adjusted.interior[geometry::kFocalLength], 1.0);
}

}  // namespace

Result<Procedure> run_procedure(const Problem& problem, const FrameRoles& roles,
                                const Priors& priors, const Options& options) {
  if (auto status = check_case(problem); !status) return status.error();
  const Length& length = problem.lengths.front();
  Procedure out;
  out.priors = priors;
  out.declared = in_words(priors, problem.camera);
  const geometry::Camera camera = camera_with(priors, problem.camera);
  auto heights = heights_from(problem, length);
  if (!heights) return heights.error();
  out.heights = *std::move(heights);
  auto relative = relative_orientation(problem, camera, out.heights, length, priors);
  if (!relative) return relative.error();
  out.relative = *std::move(relative);
  auto intersection = intersect(problem, out.heights, out.relative, priors);
  if (!intersection) return intersection.error();
  out.intersection = *std::move(intersection);
  auto model = scaled_model(problem, out.relative, out.intersection, length, roles);
  if (!model) return model.error();
  out.model = *std::move(model);
  const FramedCase framed{problem, camera, length, roles, priors};
  out.resection = resect(framed, out.relative, out.model);
  auto final_adjustment = adjust_all(framed, out.resection, options);
  if (!final_adjustment) return final_adjustment.error();
  out.adjusted = std::move(final_adjustment->stage);
  out.solution = std::move(final_adjustment->solution);
  add_standard_accuracy(out);
  return out;
}

}  // namespace plumbline::orient::paper
