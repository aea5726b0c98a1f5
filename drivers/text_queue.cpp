// SPDX-License-Identifier: MIT
#include "drivers/text_queue.h"

#include <chrono>
#include <utility>

namespace plumbline {
namespace {

constexpr std::size_t kMostTexts = 32;
constexpr std::chrono::seconds kLongestWait{10};

}  // namespace

void TextQueue::push(WaitingText text) {
  const std::lock_guard lock(mutex_);
  if (texts_.size() == kMostTexts) {
    texts_.pop_front();
    ++dropped_;
  }
  texts_.push_back(std::move(text));
}

std::optional<WaitingText> TextQueue::pop(HostTime now) {
  const std::lock_guard lock(mutex_);
  while (!texts_.empty()) {
    WaitingText text = std::move(texts_.front());
    texts_.pop_front();
    if (now - text.said < kLongestWait) return text;
    ++dropped_;
  }
  return std::nullopt;
}

void TextQueue::count_dropped() {
  const std::lock_guard lock(mutex_);
  ++dropped_;
}

void TextQueue::drop_all() {
  const std::lock_guard lock(mutex_);
  dropped_ += texts_.size();
  texts_.clear();
}

std::uint64_t TextQueue::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace plumbline
