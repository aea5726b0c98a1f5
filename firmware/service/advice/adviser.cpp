// SPDX-License-Identifier: MIT
#include "firmware/service/advice/adviser.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "edge/base/median.h"
#include "edge/plan/model.h"
#include "firmware/ingest/camera_toml.h"
#include "firmware/ingest/usual_lens.h"
#include "firmware/service/advice/calibration_size.h"
#include "firmware/service/disk/disk_space.h"

namespace plumbline::service {
namespace {

// Without a calibration, as `plumbline measure` begins where EXIF says nothing.
geometry::Camera usual_camera(const CameraOptions& options) {
  const PhotoSize size = photo_size(options);
  return ingest::usual_lens(size.width_px, size.height_px);
}

// The daemon takes photos at the heights of its plan, and so far aside as that says. By time it
// takes them everywhere.
void keep_to(const capture::CapturePlan& capture, plan::Options& options) {
  options.least_aside_m = capture.aside_m.value_or(std::numeric_limits<double>::infinity());
  options.photos_between = false;
  if (capture.heights_m.empty() || capture.every) return;
  options.ceiling_m = capture.heights_m.back();
  options.floor_m = capture.heights_m.front();
}

// So many of each the planner takes and answers in under a second: photos of the climb, of a grid,
// and heights to come.
constexpr std::size_t kMostAsked = 25;

// Every second, third, ... where there are too many; the first and the last are among them.
template <typename T>
std::vector<T> thinned(const std::vector<T>& all) {
  if (all.size() <= kMostAsked) return all;
  std::vector<T> some;
  for (std::size_t k = 0; k < kMostAsked; ++k) {
    some.push_back(all[k * (all.size() - 1) / (kMostAsked - 1)]);
  }
  return some;
}

bool is_of_grid(const FlownPhoto& photo) {
  return photo.target.reason == capture::Reason::kTime ||
         photo.target.reason == capture::Reason::kDistance;
}

// Of a long flight: the climb, thinned out, and of the grid the last photos, which see the same
// ground. What the next ones will measure is as good.
std::vector<FlownPhoto> asked_about(const std::vector<FlownPhoto>& photos) {
  std::vector<std::size_t> climb, grid;
  for (std::size_t k = 0; k < photos.size(); ++k)
    (is_of_grid(photos[k]) ? grid : climb).push_back(k);
  std::vector<std::size_t> asked = thinned(climb);
  asked.insert(asked.end(),
               grid.end() - static_cast<std::ptrdiff_t>(std::min(grid.size(), kMostAsked)),
               grid.end());
  std::sort(asked.begin(), asked.end());
  std::vector<FlownPhoto> some;
  for (const std::size_t k : asked) some.push_back(photos[k]);
  return some;
}

// Of a photo to come: what the positions were so far, as a rule.
std::optional<plan::Rtk> usual_fix(const std::vector<plan::PhotoFix>& fixes) {
  if (fixes.empty()) return std::nullopt;
  std::vector<double> horizontal_m, vertical_m;
  for (const plan::PhotoFix& fix : fixes) {
    const Eigen::Vector3d m2 = fix.covariance_m2.diagonal();
    horizontal_m.push_back(std::sqrt(0.5 * (m2.x() + m2.y())));
    vertical_m.push_back(std::sqrt(m2.z()));
  }
  return plan::Rtk{upper_median(std::move(horizontal_m)), upper_median(std::move(vertical_m))};
}

bool ends_at_top(const std::vector<double>& to_come_m) {
  return to_come_m.empty() ||
         to_come_m.back() >= *std::max_element(to_come_m.begin(), to_come_m.end());
}

}  // namespace

Result<AdviserOptions> adviser_options(const config::Config& config) {
  AdviserOptions options;
  options.capture = config.capture.plan;
  options.plan.goal_m = config.advice.goal_m;
  if (config.receiver.pps.empty()) {
    options.latency_sigma_s =
        std::chrono::duration<double>(config.capture.receiver_latency.sigma).count();
  }
  keep_to(options.capture, options.plan);
  if (config.camera.calibration.empty()) {
    options.plan.camera = usual_camera(config.camera.options);
    return options;
  }
  auto file = ingest::read_camera_toml(config.camera.calibration);
  if (!file) return file.error();
  if (const auto other = other_size(config.camera, file->camera)) return Error{*other};
  options.plan.camera = std::move(file->camera);
  return options;
}

std::optional<Advice> advise(const std::vector<FlownPhoto>& photos, const AdviserOptions& options) {
  if (photos.size() < 2) return std::nullopt;
  const std::vector<double> to_come_m = heights_to_come(options.capture, photos);
  const plan::Flight flight =
      flight_of(asked_about(photos), thinned(to_come_m), options.latency_sigma_s);
  plan::Options asked = options.plan;
  asked.rtk = usual_fix(flight.taken_fixes);
  asked.delay_sigma_s = asked.rtk ? options.latency_sigma_s : 0;
  auto summary = plan::plan(flight, asked);
  if (!summary) return std::nullopt;
  Outlook outlook{std::move(*summary), std::nullopt, ends_at_top(to_come_m),
                  static_cast<int>(photos.size()), photos_without_fix(photos)};
  if (!to_come_m.empty()) {
    plan::Flight taken = flight;
    taken.ahead_m.clear();
    const auto now = plan::predict(taken, asked, plan::Detail::kAll);
    outlook.now = now ? *now : plan::Prediction{};
  }
  return advice_of(outlook);
}

Adviser::Adviser(AdviserOptions options, Sink sink)
    : options_(std::move(options)), sink_(std::move(sink)), thread_([this] { run(); }) {}

Adviser::~Adviser() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Adviser::remember(std::vector<FlownPhoto> photos) {
  const std::lock_guard lock(mutex_);
  earlier_ = std::move(photos);
}

void Adviser::decided(const capture::Decision& decision,
                      const std::optional<geodesy::LocalFrame>& frame) {
  const std::lock_guard lock(mutex_);
  if (const auto* phase = std::get_if<capture::PhaseChanged>(&decision.what)) {
    if (phase->phase == capture::Phase::kFlying) photos_ = std::exchange(earlier_, {});
    if (phase->phase == capture::Phase::kLanded) earlier_.clear();
    return;
  }
  const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what);
  if (taken == nullptr) return;
  auto photo = flown_photo(*taken, frame);
  if (!photo) return;
  photos_.push_back(std::move(*photo));
  asked_ = true;
  changed_.notify_one();
}

void Adviser::run() {
  for (;;) {
    std::vector<FlownPhoto> photos;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return asked_ || stopping_; });
      if (stopping_) return;
      asked_ = false;
      photos = photos_;
    }
    const auto advice = advise(photos, options_);
    {
      const std::lock_guard lock(mutex_);
      if (asked_) continue;  // another photo has come meanwhile
    }
    if (advice) sink_(*advice);
  }
}

}  // namespace plumbline::service
