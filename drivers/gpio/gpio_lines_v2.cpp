// SPDX-License-Identifier: MIT
#include <gpiod.h>

#include <cerrno>

#include "drivers/gpio/gpio_lines.h"

namespace plumbline::gpio {
namespace {

constexpr const char* kConsumer = "plumbline";
constexpr std::size_t kAtOnce = 64;

template <auto kFree>
struct FreeWith {
  template <typename T>
  void operator()(T* pointer) const {
    kFree(pointer);
  }
};
using Chip = std::unique_ptr<gpiod_chip, FreeWith<gpiod_chip_close>>;
using Settings = std::unique_ptr<gpiod_line_settings, FreeWith<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, FreeWith<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, FreeWith<gpiod_request_config_free>>;
using Request = std::unique_ptr<gpiod_line_request, FreeWith<gpiod_line_request_release>>;
using Events = std::unique_ptr<gpiod_edge_event_buffer, FreeWith<gpiod_edge_event_buffer_free>>;

std::optional<ChipAndOffset> find_by_name(const std::string& name) {
  for (const std::string& path : chip_paths()) {
    const Chip chip(gpiod_chip_open(path.c_str()));
    if (!chip) continue;
    const int offset = gpiod_chip_get_line_offset_from_name(chip.get(), name.c_str());
    if (offset >= 0) return ChipAndOffset{path, static_cast<unsigned>(offset)};
  }
  return std::nullopt;
}

gpiod_line_bias bias_of(Bias bias) {
  switch (bias) {
    case Bias::kAsIs:
      return GPIOD_LINE_BIAS_AS_IS;
    case Bias::kDisabled:
      return GPIOD_LINE_BIAS_DISABLED;
    case Bias::kPullUp:
      return GPIOD_LINE_BIAS_PULL_UP;
    case Bias::kPullDown:
      return GPIOD_LINE_BIAS_PULL_DOWN;
  }
  return GPIOD_LINE_BIAS_AS_IS;
}

struct Taken {
  Request request;
  unsigned offset = 0;
};

void describe(const LineSettings& settings, bool output, gpiod_line_settings* line) {
  gpiod_line_settings_set_active_low(line, settings.active_low);
  gpiod_line_settings_set_bias(line, bias_of(settings.bias));
  if (output) {
    gpiod_line_settings_set_direction(line, GPIOD_LINE_DIRECTION_OUTPUT);
    gpiod_line_settings_set_output_value(line, GPIOD_LINE_VALUE_INACTIVE);
  } else {
    gpiod_line_settings_set_direction(line, GPIOD_LINE_DIRECTION_INPUT);
    gpiod_line_settings_set_edge_detection(line, GPIOD_LINE_EDGE_BOTH);
    gpiod_line_settings_set_event_clock(line, GPIOD_LINE_CLOCK_MONOTONIC);
  }
}

Result<Taken> take(const LineSettings& settings, bool output) {
  auto place = chip_and_offset(settings.line);
  if (!place) place = find_by_name(settings.line);
  if (!place) return line_error("find", settings.line, ENOENT);
  const Chip chip(gpiod_chip_open(place->chip_path.c_str()));
  if (!chip) return line_error("find", settings.line, errno);
  const Settings line(gpiod_line_settings_new());
  const LineConfig config(gpiod_line_config_new());
  const RequestConfig request(gpiod_request_config_new());
  if (!line || !config || !request) return line_error("take", settings.line, ENOMEM);
  describe(settings, output, line.get());
  gpiod_request_config_set_consumer(request.get(), kConsumer);
  if (gpiod_line_config_add_line_settings(config.get(), &place->offset, 1, line.get()) != 0)
    return line_error("take", settings.line, errno);
  Request taken(gpiod_chip_request_lines(chip.get(), request.get(), config.get()));
  if (!taken) return line_error("take", settings.line, errno);
  return Taken{std::move(taken), place->offset};
}

class OutputLineV2 : public OutputLine {
 public:
  OutputLineV2(Taken taken, std::string name) : taken_(std::move(taken)), name_(std::move(name)) {}

  Status set(bool active) override {
    const gpiod_line_value value = active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    if (gpiod_line_request_set_value(taken_.request.get(), taken_.offset, value) != 0)
      return line_error("set", name_, errno);
    return Done{};
  }

 private:
  Taken taken_;
  std::string name_;
};

class InputLineV2 : public InputLine {
 public:
  InputLineV2(Taken taken, std::string name)
      : taken_(std::move(taken)),
        name_(std::move(name)),
        events_(gpiod_edge_event_buffer_new(kAtOnce)) {}

  int descriptor() const override { return gpiod_line_request_get_fd(taken_.request.get()); }

  Result<std::vector<RawEdge>> read() override {
    const int count =
        gpiod_line_request_read_edge_events(taken_.request.get(), events_.get(), kAtOnce);
    if (count < 0) return line_error("read edges of", name_, errno);
    std::vector<RawEdge> edges;
    for (int i = 0; i < count; ++i) {
      gpiod_edge_event* event =
          gpiod_edge_event_buffer_get_event(events_.get(), static_cast<unsigned long>(i));
      const auto time = static_cast<std::int64_t>(gpiod_edge_event_get_timestamp_ns(event));
      edges.push_back({HostTime(std::chrono::nanoseconds(time)),
                       gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE,
                       gpiod_edge_event_get_line_seqno(event)});
    }
    return edges;
  }

 private:
  Taken taken_;
  std::string name_;
  Events events_;
};

}  // namespace

Result<std::unique_ptr<OutputLine>> open_output(const LineSettings& settings) {
  auto taken = take(settings, true);
  if (!taken) return taken.error();
  return std::unique_ptr<OutputLine>(
      std::make_unique<OutputLineV2>(std::move(*taken), settings.line));
}

Result<std::unique_ptr<InputLine>> open_input(const LineSettings& settings) {
  auto taken = take(settings, false);
  if (!taken) return taken.error();
  return std::unique_ptr<InputLine>(
      std::make_unique<InputLineV2>(std::move(*taken), settings.line));
}

}  // namespace plumbline::gpio
