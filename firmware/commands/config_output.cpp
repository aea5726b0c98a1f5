// SPDX-License-Identifier: MIT
#include "firmware/commands/config_output.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "firmware/config/key.h"
#include "firmware/config/value.h"

namespace plumbline::commands {
namespace {

using config::Config;

std::string number(double value) { return config::figures(value); }

template <typename Duration>
std::string seconds(Duration duration) {
  using PerSecond = std::chrono::duration<double>;
  return number(std::chrono::duration_cast<PerSecond>(duration).count()) + " s";
}

// "first, second" of those that are not empty.
std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  }
  return text;
}

std::string line(const std::string& what, const std::vector<std::string>& parts) {
  return "  " + what + std::string(11 - what.size(), ' ') + joined(parts) + '\n';
}

std::string receiver(const Config& config) {
  const timing::Latency& latency = config.capture.receiver_latency;
  return line("receiver",
              {config.receiver.address,
               config.receiver.pps.empty()
                   ? "latency " + seconds(latency.value) + " +- " + seconds(latency.sigma)
                   : "pulse per second on " + config.receiver.pps});
}

std::string size(const CameraOptions& options) {
  if (!options.width_px && !options.height_px) return "largest photos";
  const auto side = [](std::optional<int> px) { return px ? std::to_string(*px) : "any"; };
  return side(options.width_px) + " x " + side(options.height_px) + " pixels";
}

std::string camera(const Config& config) {
  if (config.camera.id == config::CameraConfig::kNone) {
    return line("camera", {"none here: that on the line keeps its photos"});
  }
  const CameraOptions& options = config.camera.options;
  return line("camera", {config.camera.id.empty() ? "the first that is found" : config.camera.id,
                         size(options),
                         std::string(options.fixed_exposure ? "exposed " : "exposed at most ") +
                             seconds(options.longest_exposure)});
}

std::string way(capture::Direction direction) {
  switch (direction) {
    case capture::Direction::kUp:
      return "on the way up";
    case capture::Direction::kDown:
      return "on the way down";
    case capture::Direction::kBoth:
      return "on the way up and down";
  }
  return {};
}

std::string photos(const Config& config) {
  const capture::CapturePlan& plan = config.capture.plan;
  const std::vector<double>& heights = plan.heights_m;
  return line(
      "photos",
      {std::to_string(heights.size()) + (heights.size() == 1 ? " height" : " heights") + " from " +
           number(heights.front()) + " to " + number(heights.back()) + " m " + way(plan.direction),
       plan.aside_m ? "every " + number(*plan.aside_m) + " m aside" : "",
       plan.every ? "every " + seconds(*plan.every) : "",
       plan.every_m ? "every " + number(*plan.every_m) + " m flown" : ""});
}

std::string release(const Config& config) {
  const bool pulse = config.capture.release.release == capture::Release::kPulse;
  const std::string& feedback = config.trigger.feedback_line;
  return line("taken", {pulse ? "by pulses on " + config.trigger.line : "as the nearest frame",
                        feedback.empty() ? "" : "feedback on " + feedback});
}

std::string take_off(const capture::TakeOffOptions& options) {
  const std::string rise = number(options.rise_m);
  switch (options.by) {
    case capture::TakeOffBy::kArmed:
      return "when the autopilot is armed";
    case capture::TakeOffBy::kRelativeAltitude:
      return rise + " m above where the autopilot was armed";
    case capture::TakeOffBy::kHeight:
      break;
  }
  return rise + " m above the ground";
}

std::string flight(const Config& config) {
  return line("begins",
              {take_off(config.capture.take_off),
               config.pilot.link.empty() ? "no autopilot" : "autopilot on " + config.pilot.link});
}

std::string recording(const Config& config) {
  return line("recorded",
              {"in " + config.recording.folder,
               std::to_string(config.recording.keep_free_mb) + " MB of the disk not counted on"});
}

std::string measuring(const Config& config) {
  const std::string limits = "with " + std::to_string(config.measure.memory_mb) + " MB and " +
                             seconds(config.measure.longest);
  return line("measured",
              {config.measure.enabled ? limits : "not on board",
               config.advice.enabled ? "advice towards " + number(config.advice.goal_m) + " m"
                                     : "no advice"});
}

nlohmann::ordered_json json_of(const config::Value& value) {
  return std::visit(
      [](const auto& held) -> nlohmann::ordered_json {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) {
          return nullptr;
        } else {
          return held;
        }
      },
      value);
}

}  // namespace

std::string config_lines(const Config& config) {
  return receiver(config) + camera(config) + photos(config) + release(config) + flight(config) +
         recording(config) + measuring(config);
}

std::string config_json(const std::string& file, const config::ConfigReading& reading) {
  nlohmann::ordered_json json = {{"file", file}, {"good", reading.errors.empty()}};
  json["errors"] = nlohmann::ordered_json::array();
  for (const Error& error : reading.errors) json["errors"].push_back(error.sentence);
  for (const config::Key& key : config::keys()) {
    json["config"][std::string(key.section)][std::string(key.name)] =
        json_of(key.get(reading.config));
  }
  json["heights_m"] = reading.config.capture.plan.heights_m;
  using Json = nlohmann::ordered_json;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace plumbline::commands
