// SPDX-License-Identifier: MIT
#include "drivers/gpio/gpio_lines.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <system_error>

namespace plumbline::gpio {
namespace {

std::string why(int code) {
  switch (code) {
    case EACCES:
    case EPERM:
      return "no right to; make the user a member of the group that owns /dev/gpiochip* (gpio)";
    case EBUSY:
      return "another program holds it";
    case ENOENT:
      return "there is no such chip or line; gpioinfo lists what there is";
    case EINVAL:
      return "the chip has no such line, or cannot do what is asked of it";
    case ENODEV:
    case ENXIO:
      return "the chip is gone";
    default:
      return std::generic_category().message(code);
  }
}

}  // namespace

std::optional<ChipAndOffset> chip_and_offset(const std::string& line) {
  const std::size_t colon = line.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == line.size()) return std::nullopt;
  ChipAndOffset out;
  const char* end = line.data() + line.size();
  const auto [rest, fault] = std::from_chars(line.data() + colon + 1, end, out.offset);
  if (fault != std::errc() || rest != end) return std::nullopt;
  const std::string chip = line.substr(0, colon);
  out.chip_path = chip.starts_with('/') ? chip : "/dev/" + chip;
  return out;
}

std::vector<std::string> chip_paths() {
  std::vector<std::string> paths;
  std::error_code fault;
  for (std::filesystem::directory_iterator entry("/dev", fault), end; !fault && entry != end;
       entry.increment(fault)) {
    if (entry->path().filename().string().starts_with("gpiochip"))
      paths.push_back(entry->path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

Error line_error(const std::string& attempted, const std::string& line, int code) {
  return {"Cannot " + attempted + " the GPIO line '" + line + "': " + why(code) + "."};
}

}  // namespace plumbline::gpio
