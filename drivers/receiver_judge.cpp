// SPDX-License-Identifier: MIT
#include "drivers/receiver_judge.h"

#include <algorithm>
#include <cstdio>

namespace plumbline {
namespace {

// A receiver sends once a second at the slowest; a fault is to be known within two.
constexpr std::chrono::milliseconds kReceiverPatience{1500};

std::string decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string kind_of(FixQuality quality) {
  switch (quality) {
    case FixQuality::kSingle:
      return "without corrections";
    case FixQuality::kDifferential:
      return "with differential corrections";
    case FixQuality::kFloat:
      return "float";
    case FixQuality::kFixed:
      return "fixed";
    default:
      return "of the precise service";
  }
}

std::string satellites_of(const GnssFix& fix) {
  return fix.satellites ? " from " + std::to_string(*fix.satellites) + " satellites" : "";
}

std::string no_position_sentence(const std::string& name, const GnssFix& fix) {
  if (fix.latitude_deg) {
    return name + " gives a position that it did not measure (estimated, typed in or simulated): " +
           "switch that off, and give the antenna a free view of the sky.";
  }
  return name + " has no position" + satellites_of(fix) +
         ": give the antenna a free view of the sky, and wait.";
}

}  // namespace

void ReceiverJudge::opened(HostTime now) {
  open_ = true;
  last_byte_ = bytes_since_ = last_sentence_ = sentences_since_ = last_epoch_ = now;
}

void ReceiverJudge::absent(HostTime now, const std::string& sentence, bool again) {
  open_ = false;
  if (again && sentence != sentence_) {
    report(now, ReceiverState::kAbsent, sentence);
  } else {
    become(now, ReceiverState::kAbsent, sentence);
  }
}

void ReceiverJudge::bytes_came(HostTime now) {
  if (now >= silent_at()) bytes_since_ = now;
  last_byte_ = now;
}

void ReceiverJudge::sentence_came(HostTime now) {
  if (now >= last_sentence_ + kReceiverPatience) sentences_since_ = now;
  last_sentence_ = now;
}

void ReceiverJudge::epoch_came(HostTime now, const GnssFix& fix) {
  last_epoch_ = now;
  if (!is_measured_position(fix)) {
    become(now, ReceiverState::kNoFix, no_position_sentence(name_, fix));
    return;
  }
  if (const auto jump = jumps_.take(fix, now)) {
    report(now, ReceiverState::kJumped,
           "The position that " + name_ + " gives jumped by " + decimal(jump->distance_m) +
               " m within " + decimal(jump->seconds) +
               " s: one of the two is wrong; let the receiver find its solution anew.");
    return;
  }
  become(now, ReceiverState::kPosition,
         name_ + " gives positions (" + kind_of(fix.quality) + satellites_of(fix) + ").");
}

void ReceiverJudge::look(HostTime now) {
  if (!open_) return;
  if (now >= silent_at()) {
    become(now, ReceiverState::kSilent,
           "Nothing comes from " + name_ +
               ": check that the receiver is on, and that its position output goes to this port.");
  } else if (now >= garbled_at()) {
    become(now, ReceiverState::kGarbled,
           "What comes from " + name_ +
               " cannot be read: set the receiver's output to NMEA or LLH and to the speed of this "
               "port, and check the cable.");
  } else if (now >= no_epoch_at()) {
    become(now, ReceiverState::kNoFix,
           name_ +
               " sends sentences but no position: switch on GGA (or LLH) in the receiver's "
               "position output.");
  }
}

HostTime ReceiverJudge::due(HostTime now) const {
  HostTime next = HostTime::max();
  if (!open_) return next;
  for (const HostTime at : {silent_at(), garbled_at(), no_epoch_at()}) {
    if (at > now) next = std::min(next, at);
  }
  return next;
}

HostTime ReceiverJudge::silent_at() const { return last_byte_ + kReceiverPatience; }

HostTime ReceiverJudge::garbled_at() const {
  return std::max(bytes_since_, last_sentence_) + kReceiverPatience;
}

HostTime ReceiverJudge::no_epoch_at() const {
  return std::max(sentences_since_, last_epoch_) + kReceiverPatience;
}

void ReceiverJudge::become(HostTime now, ReceiverState state, const std::string& sentence) {
  if (!reported_ || state != state_) report(now, state, sentence);
}

void ReceiverJudge::report(HostTime now, ReceiverState state, const std::string& sentence) {
  reported_ = true;
  state_ = state;
  sentence_ = sentence;
  sink_({now, state, sentence});
}

}  // namespace plumbline
