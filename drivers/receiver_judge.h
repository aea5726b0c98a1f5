// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "drivers/gnss_receiver.h"
#include "drivers/jump_check.h"

namespace plumbline {

// Says in which state a receiver is, from what arrives and what does not. It reports when the state
// changes, and each jump. Knows no clock: every call brings the time, which never goes back.
class ReceiverJudge {
 public:
  using Sink = std::function<void(ReceiverReport)>;

  explicit ReceiverJudge(Sink sink) : sink_(std::move(sink)) {}

  // For the sentences: "/dev/ttyACM0 at 115200 baud".
  void set_name(std::string name) { name_ = std::move(name); }

  void opened(HostTime now);
  // `again`: reported also where it was absent already, if the sentence is another.
  void absent(HostTime now, const std::string& sentence, bool again);
  void bytes_came(HostTime now);
  void sentence_came(HostTime now);
  void epoch_came(HostTime now, const GnssFix& fix);

  void look(HostTime now);           // at what has not come
  HostTime due(HostTime now) const;  // when to look again; HostTime::max() for never

 private:
  void become(HostTime now, ReceiverState state, const std::string& sentence);
  void report(HostTime now, ReceiverState state, const std::string& sentence);
  HostTime silent_at() const;
  HostTime garbled_at() const;
  HostTime no_epoch_at() const;

  Sink sink_;
  std::string name_;
  bool open_ = false;
  bool reported_ = false;
  ReceiverState state_ = ReceiverState::kAbsent;
  std::string sentence_;
  HostTime last_byte_;
  HostTime bytes_since_;  // without a long pause
  HostTime last_sentence_;
  HostTime sentences_since_;  // without a long pause
  HostTime last_epoch_;
  JumpCheck jumps_;
};

}  // namespace plumbline
