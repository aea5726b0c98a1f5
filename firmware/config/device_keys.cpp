// SPDX-License-Identifier: MIT
#include "firmware/config/make_key.h"
#include "firmware/config/places.h"
#include "firmware/config/section_keys.h"

namespace plumbline::config {
namespace {

constexpr const char* kLine =
    R"("" (none), a line such as "/dev/gpiochip0:17", or the name of a line)";

std::vector<Key> receiver_keys() {
  return {
      text({"receiver", "address",
            "The receiver's port, with its speed after @ or without (then it is found by trying), "
            "or its address in the network."},
           R"("/dev/ttyACM0", "/dev/ttyAMA0@38400" or "tcp://HOST:PORT")", is_receiver_address,
           PLUMBLINE_FIELD(receiver.address)),
      number({"receiver", "latency_s",
              "How long after an instant the first byte about it arrives, at the least. A pulse "
              "per second does without."},
             kSeconds, {0, 2}, PLUMBLINE_FIELD(capture.receiver_latency.value)),
      number({"receiver", "latency_sigma_s",
              "The standard deviation of that: at 3 metres per second, 0.03 is 9 cm of height."},
             kSeconds, {0, 1}, PLUMBLINE_FIELD(capture.receiver_latency.sigma)),
      text({"receiver", "pps",
            "The receiver's pulse per second: a GPIO line where possible, else a PPS device."},
           R"("" (none), "gpio:/dev/gpiochip0:18" or "/dev/pps0")", is_pps_or_empty,
           PLUMBLINE_FIELD(receiver.pps)),
      text({"receiver", "datum",
            "The datum of the base's coordinates, such as \"JGD2024\": a name for the results."},
           "a name in quotes, at most 200 bytes", is_text, PLUMBLINE_FIELD(receiver.datum)),
  };
}

std::vector<Key> camera_keys() {
  return {
      text({"camera", "id",
            "The camera, as plumbline camera lists it; \"\" takes the first of that list, "
            "\"none\" is for one that the line under [release] releases and that keeps its photos "
            "itself."},
           "an id in quotes such as \"/dev/video0\", at most 200 bytes", is_text,
           PLUMBLINE_FIELD(camera.id)),
      number_or_auto({"camera", "width_px", "The width of the photos; \"auto\": the largest."},
                     kPixels, {16, 20'000}, PLUMBLINE_FIELD(camera.options.width_px)),
      number_or_auto({"camera", "height_px", "The height of the photos; \"auto\": the largest."},
                     kPixels, {16, 20'000}, PLUMBLINE_FIELD(camera.options.height_px)),
      number_or_auto({"camera", "frames_per_s",
                      "How many frames the camera streams; the one nearest to a height is kept."},
                     kPerSecond, {0.1, 1'000}, PLUMBLINE_FIELD(camera.options.frames_per_s)),
      number({"camera", "longest_exposure_ms",
              "No exposure is longer, so that nothing blurs; the gain makes up for it."},
             kMilliseconds, {0.01, 1'000}, PLUMBLINE_FIELD(camera.options.longest_exposure)),
      yes_or_no({"camera", "fixed_exposure", "Every exposure is the longest, whatever the light."},
                PLUMBLINE_FIELD(camera.options.fixed_exposure)),
      number_or_auto({"camera", "gain", "A constant gain, 1 amplifies nothing; \"auto\": to suit."},
                     kPlain, {1, 1'000}, PLUMBLINE_FIELD(camera.options.fixed_gain)),
      number_or_auto({"camera", "lens_position_dioptre",
                      "The focus is locked: here (0: infinity), or with \"auto\" where it is."},
                     kDioptres, {0, 50}, PLUMBLINE_FIELD(camera.options.lens_position_dioptre)),
      number_or_auto({"camera", "row_time_us",
                      "Rolling shutter: from one row to the next; 0: none, \"auto\": the driver "
                      "knows."},
                     kMicroseconds, {0, 1'000}, PLUMBLINE_FIELD(camera.options.row_time)),
      number({"camera", "jpeg_quality", "The quality of the photos as JPEG."}, kPlain, {50, 100},
             PLUMBLINE_FIELD(camera.jpeg_quality)),
      text({"camera", "calibration",
            "The path of this camera's camera.toml; each flight gets a copy."},
           "\"\" (none) or a path that begins with /", is_absolute_path_or_empty,
           PLUMBLINE_FIELD(camera.calibration)),
  };
}

std::vector<Key> release_keys() {
  return {
      choice({"release", "by",
              "What takes the photo: \"frame\" keeps the nearest one of a camera that runs freely, "
              "\"pulse\" sends a pulse on the line."},
             {{"frame", capture::Release::kNearestFrame}, {"pulse", capture::Release::kPulse}},
             PLUMBLINE_FIELD(capture.release.release)),
      text({"release", "line", "The GPIO line to the camera's shutter."}, kLine,
           is_gpio_line_or_empty, PLUMBLINE_FIELD(trigger.line)),
      number({"release", "pulse_ms", "How long the pulse lasts."}, kMilliseconds, {0.1, 2'000},
             PLUMBLINE_FIELD(trigger.pulse)),
      yes_or_no({"release", "active_low", "The pulse is low, and the line high between pulses."},
                PLUMBLINE_FIELD(trigger.active_low)),
      text({"release", "feedback_line",
            "The GPIO line from the camera's hot shoe, which says when it exposed."},
           kLine, is_gpio_line_or_empty, PLUMBLINE_FIELD(trigger.feedback_line)),
      yes_or_no({"release", "feedback_active_low", "An exposure pulls that line low."},
                PLUMBLINE_FIELD(trigger.feedback_active_low)),
      yes_or_no({"release", "answered",
                 "A frame or an edge of feedback_line says when the exposure was; false: nothing "
                 "does, and delay_s is taken for true."},
                PLUMBLINE_FIELD(capture.release.is_answered)),
      number({"release", "delay_s",
              "From pulse to the middle of the exposure, until the first photos tell."},
             kSeconds, {0, 5}, PLUMBLINE_FIELD(capture.release.delay)),
      number({"release", "longest_delay_s", "An exposure later than this is another's, or none."},
             kSeconds, {0.01, 10}, PLUMBLINE_FIELD(capture.release.longest_delay)),
      number({"release", "test_pulses", "Pulses on the ground to learn the delay."}, kPlain,
             {0, 20}, PLUMBLINE_FIELD(capture.release.test_pulses)),
  };
}

std::vector<Key> pilot_keys() {
  return {
      text({"pilot", "link", "MAVLink to the autopilot: its messages are read, advice is sent."},
           R"("" (none), "udp://HOST:PORT" or a port such as "/dev/ttyAMA1@57600")",
           is_pilot_link_or_empty, PLUMBLINE_FIELD(pilot.link)),
      number({"pilot", "system_id", "The vehicle's system id, which is Plumbline's too."}, kPlain,
             {1, 255}, PLUMBLINE_FIELD(pilot.system_id)),
      number_or(
          Value(std::string("unknown")),
          {"pilot", "photo_top_deg",
           "Where the top of the photos points, from the vehicle's nose clockwise: where that "
           "is known, the autopilot's heading is that of the photos. 0: the nose is at their "
           "top."},
          kDegrees, {0, 360}, PLUMBLINE_FIELD(pilot.photo_top_deg)),
      number({"pilot", "heading_sigma_deg",
              "The standard deviation of that heading, common to the flight: it is a compass's."},
             kDegrees, {0.1, 45}, PLUMBLINE_FIELD(pilot.heading_sigma_deg)),
  };
}

}  // namespace

std::vector<Key> device_keys() {
  std::vector<Key> all = receiver_keys();
  for (const auto& part : {camera_keys(), release_keys(), pilot_keys()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace plumbline::config
