// SPDX-License-Identifier: MIT
#include "drivers/patient_line.h"

#include <utility>

namespace plumbline {

PatientLine::PatientLine(Open open, const Clock& clock, PatientLineOptions options)
    : open_(std::move(open)), clock_(clock), options_(std::move(options)) {}

PatientLine::~PatientLine() { PatientLine::stop(); }

Result<Pulse> PatientLine::pulse() {
  const std::lock_guard lock(mutex_);
  if (!line_ && !listening_) {
    auto opened = open_();
    if (!opened) return opened.error();
    line_ = std::move(opened).value();
  }
  if (!line_) return Error{missing_};
  auto pulsed = line_->pulse();
  if (!pulsed && options_.has_output && listening_) {
    lost_ = pulsed.error().sentence;
    changed_.notify_one();
  }
  return pulsed;
}

// The first try is made here, so that nothing is missed where the line is there.
Status PatientLine::listen(Sink sink) {
  {
    const std::lock_guard lock(mutex_);
    if (listening_) return Error{"The line is listened to already."};
    listening_ = true;
    stopping_ = false;
    lost_.reset();
  }
  sink_ = std::move(sink);
  thread_ = std::thread([this, trouble = take_line()] { run(trouble); });
  return Done{};
}

void PatientLine::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    changed_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
  if (line_) line_->stop();
  const std::lock_guard lock(mutex_);
  listening_ = false;
}

void PatientLine::on_return(std::function<void()> returned) {
  const std::lock_guard lock(mutex_);
  returned_ = std::move(returned);
}

// Empty where the line is there and listened to; else why not.
PatientLine::Trouble PatientLine::take_line() {
  std::unique_ptr<TriggerLine> line;
  {
    const std::lock_guard lock(mutex_);
    line = std::move(line_);
  }
  Trouble trouble;
  if (!line) {
    auto opened = open_();
    if (opened) {
      line = std::move(opened).value();
    } else {
      trouble = opened.error().sentence;
    }
  }
  if (line && options_.has_input) {
    const Status heard = line->listen([this](LineEvent event) { hear(std::move(event)); });
    if (!heard) trouble = heard.error().sentence;
  }
  const std::lock_guard lock(mutex_);
  if (trouble) {
    missing_ = with_meanwhile(*trouble);
  } else {
    line_ = std::move(line);
  }
  return trouble;
}

void PatientLine::hear(LineEvent event) {
  if (auto* fault = std::get_if<LineFault>(&event)) {
    const std::string sentence = fault->sentence;
    fault->sentence = with_meanwhile(sentence);
    sink_(std::move(event));
    lose(sentence);
  } else {
    sink_(std::move(event));
  }
}

void PatientLine::lose(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  lost_ = sentence;
  changed_.notify_one();
}

void PatientLine::run(Trouble trouble) {
  std::string told;
  for (;;) {
    if (trouble && *trouble != told) {
      told = *trouble;
      sink_(LineFault{clock_.now(), with_meanwhile(told)});
    } else if (!trouble && !std::exchange(told, "").empty()) {
      tell_return();
    }
    if (!wait(trouble)) return;
    if (trouble) {
      trouble = take_line();
      continue;
    }
    std::unique_ptr<TriggerLine> gone;
    const std::lock_guard lock(mutex_);
    gone = std::move(line_);
    trouble = std::exchange(lost_, std::nullopt);
    told = *trouble;  // by whoever lost it
    missing_ = with_meanwhile(told);
  }
}

// For the next try, or until the line is lost. False when it is to stop.
bool PatientLine::wait(const Trouble& trouble) {
  std::unique_lock lock(mutex_);
  if (trouble) {
    changed_.wait_for(lock, options_.retry, [this] { return stopping_; });
  } else {
    changed_.wait(lock, [this] { return stopping_ || lost_; });
  }
  return !stopping_;
}

void PatientLine::tell_return() {
  std::function<void()> returned;
  {
    const std::lock_guard lock(mutex_);
    returned = returned_;
  }
  if (returned) returned();
}

std::string PatientLine::with_meanwhile(const std::string& sentence) const {
  return options_.meanwhile.empty() ? sentence : sentence + " " + options_.meanwhile;
}

}  // namespace plumbline
