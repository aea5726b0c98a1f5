// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "drivers/clock.h"
#include "drivers/trigger_line.h"

namespace plumbline {

struct PatientLineOptions {
  bool has_input = true;  // that is listened to
  bool has_output = false;
  std::chrono::milliseconds retry{3000};
  std::string meanwhile;  // what it means that the line is not there, said after why
};

// A line that may be missing for a while, as other devices may: listen() does not fail then, but a
// LineFault says why, once for each reason, and the line is tried again until it is there; so it is
// when it has gone. Edges then follow after a LineFault, and are numbered anew. A thread of its own
// while it is listened to.
class PatientLine : public TriggerLine {
 public:
  using Open = std::function<Result<std::unique_ptr<TriggerLine>>()>;

  // `clock` outlives it.
  PatientLine(Open open, const Clock& clock, PatientLineOptions options = {});
  ~PatientLine() override;

  Result<Pulse> pulse() override;
  Status listen(Sink sink) override;
  void stop() override;

  // Called, from its thread, when the line is there after it was missed. From any thread.
  void on_return(std::function<void()> returned);

 private:
  using Trouble = std::optional<std::string>;

  Trouble take_line();
  void hear(LineEvent event);
  void lose(const std::string& sentence);
  void run(Trouble trouble);
  bool wait(const Trouble& trouble);
  void tell_return();
  std::string with_meanwhile(const std::string& sentence) const;

  Open open_;
  const Clock& clock_;
  PatientLineOptions options_;
  Sink sink_;
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::unique_ptr<TriggerLine> line_;
  Trouble lost_;
  std::string missing_;
  std::function<void()> returned_;
  bool listening_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace plumbline
