// SPDX-License-Identifier: MIT
#include "firmware/commands/camera_command.h"

#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "firmware/commands/camera_shot.h"
#include "firmware/commands/number_check.h"
#include "firmware/commands/run_report.h"
#include "firmware/deliver/durable_file.h"
#include "firmware/devices_on_board.h"

namespace plumbline::commands {
namespace {

using Json = nlohmann::ordered_json;

struct CameraArguments {
  std::string device;
  std::string size;
  std::string format;
  double exposure_ms = 0;
  double gain = 0;
  double rate = 0;
  std::string out = "shot.jpg";
  bool json = false;
};

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

double ms(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

Json json_of(const CameraDescription& camera) {
  Json modes = Json::array();
  for (const CameraMode& mode : camera.modes) {
    modes.push_back({{"width_px", mode.width_px},
                     {"height_px", mode.height_px},
                     {"format", name_of(mode.format)},
                     {"frames_per_s", or_null(mode.frames_per_s)}});
  }
  Json controls = Json::array();
  for (const CameraControl& control : camera.controls) {
    controls.push_back({{"name", control.name},
                        {"minimum", control.minimum},
                        {"maximum", control.maximum},
                        {"value", control.value}});
  }
  return {{"id", camera.id},
          {"name", camera.name},
          {"driver", camera.driver},
          {"modes", modes},
          {"controls", controls}};
}

void print(const CameraDescription& camera) {
  std::printf("%s\n  %s (%s)\n", camera.id.c_str(), camera.name.c_str(), camera.driver.c_str());
  for (const CameraMode& mode : camera.modes) {
    std::printf("  mode     %d x %d %s", mode.width_px, mode.height_px,
                name_of(mode.format).c_str());
    if (mode.frames_per_s) std::printf(", %.4g frames/s", *mode.frames_per_s);
    std::printf("\n");
  }
  for (const CameraControl& control : camera.controls) {
    std::printf("  control  %s: %g to %g, now %g\n", control.name.c_str(), control.minimum,
                control.maximum, control.value);
  }
}

Status list(const CameraArguments& arguments) {
  const CamerasOnBoard found = list_cameras();
  if (arguments.json) {
    Json cameras = Json::array();
    for (const CameraDescription& camera : found.cameras) cameras.push_back(json_of(camera));
    std::printf("%s\n", Json{{"cameras", cameras}, {"remarks", found.remarks}}.dump().c_str());
    return Done{};
  }
  for (const CameraDescription& camera : found.cameras) print(camera);
  for (const std::string& remark : found.remarks) std::fprintf(stderr, "%s\n", remark.c_str());
  if (found.cameras.empty()) std::printf("There is no camera here; plug one in.\n");
  return Done{};
}

Result<std::string> chosen_device(const CameraArguments& arguments) {
  if (!arguments.device.empty()) return arguments.device;
  const CamerasOnBoard found = list_cameras();
  if (!found.cameras.empty()) return found.cameras.front().id;
  std::string sentence = "There is no camera here; plug one in.";
  for (const std::string& remark : found.remarks) sentence += " " + remark;
  return Error{sentence};
}

Status read_size(const std::string& text, CameraOptions& options) {
  if (text.empty()) return Done{};
  int width = 0;
  int height = 0;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest);
  if (read != 2 || width < 1 || height < 1) {
    return Error{"'" + text + "' is not a size: write WIDTHxHEIGHT, as 4056x3040."};
  }
  options.width_px = width;
  options.height_px = height;
  return Done{};
}

// Whether the file is to be a raw one, by its name.
bool names_a_raw_file(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& letter : extension)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return extension == ".dng";
}

Result<ShotOptions> options_of(const CameraArguments& arguments) {
  ShotOptions options;
  options.camera.raw = names_a_raw_file(arguments.out);
  if (const Status size = read_size(arguments.size, options.camera); !size) return size.error();
  if (!arguments.format.empty()) {
    const auto format = pixel_format_of(arguments.format);
    if (!format) return format.error();
    if (options.camera.raw && !bayer_of(*format)) {
      return Error{name_of(*format) + " is no raw format, and '" + arguments.out +
                   "' a raw file: name a Bayer format, as SRGGB10, or a file that ends in .jpg."};
    }
    options.camera.format = *format;
  }
  if (arguments.exposure_ms > 0) {
    options.camera.longest_exposure =
        std::chrono::microseconds(static_cast<int>(1000 * arguments.exposure_ms));
  }
  if (arguments.gain > 0) options.camera.fixed_gain = arguments.gain;
  if (arguments.rate > 0) options.camera.frames_per_s = arguments.rate;
  return options;
}

Status write_photo(const std::string& path, const std::vector<std::uint8_t>& content) {
  const std::filesystem::path file(path);
  std::error_code error;
  if (std::filesystem::exists(file, error)) {
    return Error{"'" + path + "' is there already; remove it or name another with --out."};
  }
  const int code = deliver::write_durably(file, {content.begin(), content.end()});
  if (code == 0) return Done{};
  return Error{deliver::why_not_written(file.parent_path(), code)};
}

void print_shot(const Shot& shot, const std::string& device, const CameraArguments& arguments) {
  const ExposureTiming& timing = shot.frame.timing;
  if (arguments.json) {
    std::printf("%s\n", Json{{"file", arguments.out},
                             {"device", device},
                             {"width_px", shot.width_px},
                             {"height_px", shot.height_px},
                             {"bytes", shot.file.size()},
                             {"exposure_ms", ms(timing.exposure)},
                             {"row_time_ms", ms(timing.row_time)},
                             {"sigma_of_time_ms", ms(timing.sigma)},
                             {"gain", or_null(shot.frame.gain)},
                             {"lens_position_dioptre", or_null(shot.frame.lens_position_dioptre)},
                             {"notices", shot.notices}}
                            .dump()
                            .c_str());
    return;
  }
  for (const std::string& notice : shot.notices) std::fprintf(stderr, "%s\n", notice.c_str());
  std::printf("%s: %d x %d px from %s, %zu bytes, exposed %.3f ms, its time known to %.1f ms\n",
              arguments.out.c_str(), shot.width_px, shot.height_px, device.c_str(),
              shot.file.size(), ms(timing.exposure), ms(timing.sigma));
}

Status shoot(const CameraArguments& arguments) {
  const Result<ShotOptions> options = options_of(arguments);
  if (!options) return options.error();
  const Result<std::string> device = chosen_device(arguments);
  if (!device) return device.error();
  const std::unique_ptr<Clock> clock = make_clock();
  const Result<std::unique_ptr<Camera>> camera = make_camera(*device, *clock);
  if (!camera) return camera.error();
  const Result<Shot> shot =
      take_shot(**camera, *options, [](Signal& signal, std::chrono::nanoseconds longest) {
        if (signal.take_until(std::chrono::steady_clock::now() + longest)) signal.raise();
      });
  if (!shot) return shot.error();
  if (const Status written = write_photo(arguments.out, shot->file); !written) return written;
  print_shot(*shot, *device, arguments);
  return Done{};
}

int status_of(const Status& done) {
  std::fflush(stdout);
  return done ? kGood : fail(done.error());
}

void add_list(CLI::App& camera, const std::shared_ptr<CameraArguments>& arguments) {
  CLI::App* list_command = camera.add_subcommand("list", "Cameras, their modes and controls");
  list_command->add_flag("--json", arguments->json, "As one JSON object");
}

CLI::App* add_shot(CLI::App& camera, const std::shared_ptr<CameraArguments>& arguments) {
  CLI::App* shot = camera.add_subcommand("shot", "One photo");
  shot->add_option("--device", arguments->device,
                   "/dev/videoN or libcamera:ID, as listed (default: the first)");
  shot->add_option("--size", arguments->size, "WIDTHxHEIGHT in pixels (default: the largest)");
  shot->add_option("--format", arguments->format, pixel_format_names());
  shot->add_option("--exposure", arguments->exposure_ms, "Longest exposure in ms (default: 2)")
      ->check(number_within(0.001, 10'000));
  shot->add_option("--gain", arguments->gain, "Fixed gain (default: the camera's choice)")
      ->check(number_within(0.001, 1'000));
  shot->add_option("--rate", arguments->rate, "Frames a second")->check(number_within(0.01, 1'000));
  shot->add_option("--out", arguments->out,
                   "JPEG file to write, or raw (.dng); must be new (default: shot.jpg)");
  shot->add_flag("--json", arguments->json, "What was taken as one JSON object");
  return shot;
}

}  // namespace

void add_camera(CLI::App& app, int& status) {
  auto arguments = std::make_shared<CameraArguments>();
  CLI::App* camera = app.add_subcommand("camera", "The cameras of this machine; one photo");
  camera->add_flag("--json", arguments->json, "As one JSON object");
  camera->require_subcommand(0, 1);
  add_list(*camera, arguments);
  const CLI::App* shot = add_shot(*camera, arguments);
  camera->footer(
      "Example: plumbline camera shot --size 1920x1080 --exposure 1 --out test.jpg\n"
      "         plumbline camera shot --format SRGGB10 --out test.dng");
  camera->callback([arguments, shot, &status] {
    status = status_of(shot->parsed() ? shoot(*arguments) : list(*arguments));
  });
}

}  // namespace plumbline::commands
