// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace plumbline {

// The newest elements of a series, the oldest first: one more than `capacity` pushes the oldest
// out. Allocates once, when it is made, for threads on which nothing may wait for memory.
template <typename T>
class Ring {
 public:
  // `capacity` > 0; T can be made from nothing.
  explicit Ring(std::size_t capacity) : slots_(capacity) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  void push_back(T element) {
    if (size_ == slots_.size()) pop_front();
    slots_[place(size_)] = std::move(element);
    ++size_;
  }
  void pop_front() {
    first_ = place(1);
    --size_;
  }
  void clear() { size_ = 0; }

  T& operator[](std::size_t index) { return slots_[place(index)]; }
  const T& operator[](std::size_t index) const { return slots_[place(index)]; }
  T& front() { return slots_[first_]; }
  const T& front() const { return slots_[first_]; }
  T& back() { return slots_[place(size_ - 1)]; }
  const T& back() const { return slots_[place(size_ - 1)]; }

 private:
  std::size_t place(std::size_t index) const { return (first_ + index) % slots_.size(); }

  std::vector<T> slots_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace plumbline
