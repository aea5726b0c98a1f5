// SPDX-License-Identifier: MIT
#include <gpiod.h>

#include <array>
#include <cerrno>

#include "drivers/gpio/gpio_lines.h"

namespace plumbline::gpio {
namespace {

constexpr const char* kConsumer = "plumbline";
constexpr std::size_t kKernelQueue = 16;  // edges of a line that Linux holds (gpiolib-cdev.c)

struct CloseChip {
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

// The line lives in the chip.
struct FoundLine {
  Chip chip;
  gpiod_line* line = nullptr;
};

FoundLine find_by_name(const std::string& name) {
  for (const std::string& path : chip_paths()) {
    FoundLine found{Chip(gpiod_chip_open(path.c_str())), nullptr};
    if (!found.chip) continue;
    found.line = gpiod_chip_find_line(found.chip.get(), name.c_str());
    if (found.line != nullptr) return found;
  }
  errno = ENOENT;
  return {};
}

FoundLine find_line(const std::string& line) {
  const auto place = chip_and_offset(line);
  if (!place) return find_by_name(line);
  FoundLine found{Chip(gpiod_chip_open(place->chip_path.c_str())), nullptr};
  if (found.chip) found.line = gpiod_chip_get_line(found.chip.get(), place->offset);
  return found;
}

int flags_of(const LineSettings& settings) {
  int flags = settings.active_low ? static_cast<int>(GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW) : 0;
  switch (settings.bias) {
    case Bias::kAsIs:
      break;
    case Bias::kDisabled:
      flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
      break;
    case Bias::kPullUp:
      flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
      break;
    case Bias::kPullDown:
      flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
  }
  return flags;
}

class OutputLineV1 : public OutputLine {
 public:
  OutputLineV1(FoundLine found, std::string name)
      : found_(std::move(found)), name_(std::move(name)) {}

  Status set(bool active) override {
    if (gpiod_line_set_value(found_.line, active ? 1 : 0) != 0)
      return line_error("set", name_, errno);
    return Done{};
  }

 private:
  FoundLine found_;
  std::string name_;
};

class InputLineV1 : public InputLine {
 public:
  InputLineV1(FoundLine found, std::string name)
      : found_(std::move(found)), name_(std::move(name)) {}

  int descriptor() const override { return gpiod_line_event_get_fd(found_.line); }

  Result<std::vector<RawEdge>> read() override {
    std::array<gpiod_line_event, kKernelQueue> events{};
    const int count = gpiod_line_event_read_multiple(found_.line, events.data(), events.size());
    if (count < 0) return line_error("read edges of", name_, errno);
    std::vector<RawEdge> edges;
    for (int i = 0; i < count; ++i) {
      const gpiod_line_event& event = events[static_cast<std::size_t>(i)];
      const auto time =
          std::chrono::seconds(event.ts.tv_sec) + std::chrono::nanoseconds(event.ts.tv_nsec);
      const bool rising = event.event_type == GPIOD_LINE_EVENT_RISING_EDGE;
      edges.push_back({HostTime(time), rising, std::nullopt});
    }
    return edges;
  }

 private:
  FoundLine found_;
  std::string name_;
};

}  // namespace

Result<std::unique_ptr<OutputLine>> open_output(const LineSettings& settings) {
  FoundLine found = find_line(settings.line);
  if (found.line == nullptr) return line_error("find", settings.line, errno);
  if (gpiod_line_request_output_flags(found.line, kConsumer, flags_of(settings), 0) != 0)
    return line_error("take", settings.line, errno);
  return std::unique_ptr<OutputLine>(
      std::make_unique<OutputLineV1>(std::move(found), settings.line));
}

Result<std::unique_ptr<InputLine>> open_input(const LineSettings& settings) {
  FoundLine found = find_line(settings.line);
  if (found.line == nullptr) return line_error("find", settings.line, errno);
  if (gpiod_line_request_both_edges_events_flags(found.line, kConsumer, flags_of(settings)) != 0)
    return line_error("take", settings.line, errno);
  return std::unique_ptr<InputLine>(std::make_unique<InputLineV1>(std::move(found), settings.line));
}

}  // namespace plumbline::gpio
