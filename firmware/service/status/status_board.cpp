// SPDX-License-Identifier: MIT
#include "firmware/service/status/status_board.h"

#include <time.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

namespace plumbline::service {
namespace {

constexpr std::chrono::seconds kOfLate{5};  // then a fix says nothing of where the antenna is

const char* name_of(capture::Phase phase) {
  static constexpr std::array<const char*, 4> kNames = {"waiting", "ready", "flying", "landed"};
  return kNames[static_cast<std::size_t>(phase)];
}

const char* name_of(FixQuality quality) {
  static constexpr std::array<const char*, 9> kNames = {"no position", "single", "differential",
                                                        "pps",         "fixed",  "float",
                                                        "estimated",   "manual", "simulated"};
  return kNames[static_cast<std::size_t>(quality)];
}

bool is_marked(const capture::Marks& marks) {
  return marks.late || marks.reckoned || marks.no_position || marks.not_fixed || marks.jumped;
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f m", value);
  return text;
}

// Of the system's clock, UTC: "2026-11-20T10:00:00Z".
std::string time_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

void StatusBoard::heard(const capture::Input& input) {
  const std::lock_guard lock(mutex_);
  if (const auto* heard = std::get_if<capture::FixHeard>(&input.what)) {
    const bool other = !fix_ || fix_->quality != heard->fix.quality;
    fix_ = heard->fix;
    fix_came_ = now_();
    if (other) changed();
  } else if (const auto* camera = std::get_if<capture::CameraSeen>(&input.what)) {
    streaming_ = camera->streaming;
    changed();
  } else if (const auto* pilot = std::get_if<capture::PilotSeen>(&input.what)) {
    pilot_seen_ = pilot->armed.has_value();
    changed();
  }
}

void StatusBoard::decided(const capture::Decision& decision) {
  const std::lock_guard lock(mutex_);
  if (const auto* phase = std::get_if<capture::PhaseChanged>(&decision.what)) {
    if (phase->phase == capture::Phase::kFlying && phase_ != capture::Phase::kFlying) {
      taken_ = stored_ = missed_ = marked_ = 0;
      last_photo_.reset();
      left_m_.clear();
      advice_.clear();
      result_.clear();
    }
    phase_ = phase->phase;
    ground_height_m_ = phase->ground_height_m;
  } else if (const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what)) {
    ++taken_;
    if (is_marked(taken->marks)) ++marked_;
    left_m_.erase(taken->target.entry);
    last_photo_ = *taken;
  } else if (std::holds_alternative<capture::PhotoMissed>(decision.what)) {
    ++missed_;
  } else if (const auto* ground = std::get_if<capture::GroundFound>(&decision.what)) {
    ground_height_m_ = ground->ground_height_m;
  } else if (const auto* passed = std::get_if<capture::HeightPassed>(&decision.what)) {
    left_m_[passed->target.entry] = passed->target.height_m;
  }
  changed();
}

void StatusBoard::said(const record::Message& message) {
  const std::lock_guard lock(mutex_);
  last_said_.insert_or_assign(message.source, message);
  changed();
}

void StatusBoard::stored(int, const std::string& folder) {
  const std::lock_guard lock(mutex_);
  ++stored_;
  flight_ = folder;
  changed();
}

void StatusBoard::ended(const std::string& folder) {
  const std::lock_guard lock(mutex_);
  last_flight_ = folder;
  changed();
}

void StatusBoard::advised(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  advice_ = sentence;
  changed();
}

void StatusBoard::measured(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  result_ = sentence;
  changed();
}

void StatusBoard::space(std::int64_t free_photos, std::int64_t planned_photos) {
  const std::lock_guard lock(mutex_);
  if (free_photos_ != free_photos || planned_photos_ != planned_photos) changed();
  free_photos_ = free_photos;
  planned_photos_ = planned_photos;
}

void StatusBoard::stopped() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  streaming_ = false;
  fix_.reset();
  last_said_.clear();
  changed();
}

const GnssFix* StatusBoard::fix_of_late() const {
  return fix_ && now_() - fix_came_ < kOfLate ? &*fix_ : nullptr;
}

const char* StatusBoard::quality() const {
  const GnssFix* fix = fix_of_late();
  return fix != nullptr ? name_of(fix->quality) : "no position";
}

std::uint64_t StatusBoard::version() const {
  const std::lock_guard lock(mutex_);
  return version_;
}

std::string StatusBoard::sentence() const {
  const std::lock_guard lock(mutex_);
  return sentence_locked();
}

std::string StatusBoard::left_behind(const char* what_then) const {
  std::string heights;
  for (const auto& [entry, height_m] : left_m_) {
    char text[32];
    std::snprintf(text, sizeof text, "%s%g m", heights.empty() ? "" : ", ", height_m);
    heights += text;
  }
  return heights.empty() ? "" : " No photo at " + heights + what_then;
}

std::string StatusBoard::sentence_locked() const {
  std::string text;
  if (stopped_) {
    text = "plumblined was stopped";
    text += phase_ == capture::Phase::kFlying
                ? " in flight; started again, it goes on with the flight. " + photos()
                : ".";
  } else if (phase_ == capture::Phase::kWaiting) {
    text = waiting();
  } else if (phase_ == capture::Phase::kReady) {
    text = ready();
  } else if (phase_ == capture::Phase::kFlying) {
    text = flying();
  } else {
    text = "Landed: " + photos() + left_behind(".");
  }
  if (phase_ != capture::Phase::kFlying && !result_.empty()) text += " " + result_;
  for (const char* source :
       {"program", "receiver", "camera", "calibration", "autopilot", "disk", "trigger line",
        "shutter line", "pulse per second", "photo", "status"}) {
    const auto said = last_said_.find(source);
    if (said == last_said_.end()) continue;
    if (said->second.severity != record::Severity::kInfo) text += " " + said->second.sentence;
  }
  return text;
}

std::string StatusBoard::waiting() const {
  const GnssFix* fix = fix_of_late();
  const bool placed = fix != nullptr && fix->quality != FixQuality::kNone;
  const std::string text = placed ? "Waiting for the camera" : "Waiting for a position";
  return text + (lacks_space() ? "; " + room() : ".");
}

std::string StatusBoard::ready() const {
  if (lacks_space()) return "Not ready: " + room();
  const auto line = last_said_.find("shutter line");
  if (!needs_frames_ && line != last_said_.end() &&
      line->second.severity == record::Severity::kFault) {
    return "Not ready: no line to the shutter.";
  }
  // They were there before.
  const GnssFix* fix = fix_of_late();
  if (fix == nullptr || fix->quality == FixQuality::kNone) return "Not ready: no position.";
  if (needs_frames_ && !streaming_) return "Not ready: no picture from the camera.";
  std::string text = std::string("Ready: ") + quality() + "; " + begins_when() + ".";
  if (free_photos_) text += " " + std::to_string(*free_photos_) + " photos fit on the disk.";
  return text;
}

std::string StatusBoard::begins_when() const {
  const bool by_pilot = take_off_.by != capture::TakeOffBy::kHeight;
  if (take_off_.by == capture::TakeOffBy::kArmed && pilot_seen_) {
    return "begins when the autopilot is armed";
  }
  char rise[64];
  std::snprintf(rise, sizeof rise, "takes off at %g m of rise%s", take_off_.rise_m,
                by_pilot && pilot_seen_ ? ", as the autopilot says" : "");
  return by_pilot && !pilot_seen_ ? std::string("no autopilot heard: ") + rise : rise;
}

std::string StatusBoard::flying() const {
  std::string text = "Flying";
  if (last_photo_ && last_photo_->place) {
    text += ", last photo at " + metres(last_photo_->place->height_m);
  }
  text += std::string(": ") + quality() + "; " + photos();
  if (needs_frames_ && !streaming_) text += " No camera sends frames: no photo is taken.";
  text += left_behind(": fly there again.");
  if (!advice_.empty()) text += " " + advice_;
  return text;
}

std::string StatusBoard::photos() const {
  return std::to_string(stored_) + " of " + std::to_string(taken_) + " photos stored" +
         (missed_ > 0 ? ", " + std::to_string(missed_) + " missed" : "") +
         (marked_ > 0 ? ", " + std::to_string(marked_) + " marked" : "") + ".";
}

std::string StatusBoard::room() const {
  return "the disk has room for " + std::to_string(*free_photos_) + " photos of " +
         std::to_string(planned_photos_) + "; move old flights to another disk.";
}

std::string StatusBoard::json() const {
  const std::lock_guard lock(mutex_);
  const GnssFix* fix = fix_of_late();
  nlohmann::ordered_json json = {{"time", time_now()},
                                 {"pid", ::getpid()},
                                 {"sentence", sentence_locked()},
                                 {"phase", stopped_ ? "stopped" : name_of(phase_)},
                                 {"quality", fix != nullptr ? static_cast<int>(fix->quality) : 0},
                                 {"camera_streaming", streaming_},
                                 {"photos_taken", taken_},
                                 {"photos_stored", stored_},
                                 {"photos_missed", missed_},
                                 {"photos_marked", marked_},
                                 {"advice", advice_},
                                 {"result", result_},
                                 {"flight", flight_},
                                 {"last_flight", last_flight_}};
  if (fix != nullptr && fix->covariance_enu_m2) {
    json["sigma_u_m"] = std::sqrt((*fix->covariance_enu_m2)(2, 2));
  }
  if (fix != nullptr && fix->height_ellipsoidal_m && ground_height_m_) {
    json["height_above_take_off_m"] = *fix->height_ellipsoidal_m - *ground_height_m_;
  }
  if (free_photos_) {
    json["free_photos"] = *free_photos_;
    json["planned_photos"] = planned_photos_;
  }
  for (const auto& [source, message] : last_said_) {
    if (message.severity != record::Severity::kInfo) json["trouble"][source] = message.sentence;
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace plumbline::service
