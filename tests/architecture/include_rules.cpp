// SPDX-License-Identifier: MIT
#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <regex>

namespace plumbline::architecture {

namespace {

// What each room of edge/ may include beside itself.
const std::map<std::string_view, std::vector<std::string_view>> kRoomsBelow = {
    {"base", {}},
    {"geometry", {"base"}},
    {"geodesy", {"base"}},
    {"gnss", {"base", "geodesy"}},
    {"timing", {"base", "geodesy", "gnss"}},
    {"mavlink", {"base"}},
    {"capture", {"base", "geodesy", "gnss", "timing"}},
    {"record", {"base", "capture"}},
    {"pixels", {"base", "jpeg"}},
    {"jpeg", {"base"}},
    {"image", {"base"}},
    {"orient", {"base", "geometry"}},
    {"plan", {"base", "geometry", "orient"}},
    {"survey", {"base", "geometry", "geodesy", "image", "orient"}},
};

// The same of edge/orient/, whose own files may include every room, and every room these of them.
const std::map<std::string_view, std::vector<std::string_view>> kOrientRoomsBelow = {
    {"network", {}},
    {"start", {"network"}},
    {"precision", {"network"}},
    {"reliability", {"network", "precision"}},
    {"findings", {"network", "precision", "reliability"}},
};
const std::vector<std::string_view> kOrientTypes = {"problem.h", "options.h", "solution.h"};

// The same of firmware/, whose own files may include every room.
const std::map<std::string_view, std::vector<std::string_view>> kFirmwareRoomsBelow = {
    {"ingest", {}},
    {"deliver", {"ingest"}},
    {"config", {"ingest"}},
    {"flight", {}},
    {"service", {"config", "flight", "ingest"}},
    {"commands", {"config", "deliver", "flight", "ingest"}},
};

struct Place {
  std::string_view header;               // how the library's headers begin
  std::vector<std::string_view> places;  // beside tests/
};
const std::vector<Place> kLibraryPlaces = {
    {"opencv2/", {"edge/image/"}},
    {"GeographicLib/", {"edge/geodesy/"}},
    {"jpeglib.h", {"edge/jpeg/"}},
    {"jerror.h", {"edge/jpeg/"}},
    {"zlib.h", {"edge/record/"}},
    {"exiv2/", {"firmware/"}},
    {"toml++/", {"firmware/", "sim/"}},
    {"nlohmann/", {"firmware/"}},
    {"systemd/", {"firmware/service/life/"}},
    {"spdlog/", {"firmware/"}},
    {"nettle/", {"edge/record/"}},
    {"CLI/", {"firmware/"}},
    {"libcamera/", {"drivers/camera/"}},
    {"gpiod.h", {"drivers/gpio/"}},
    {"ceres/", {}},
    {"gtest/", {}},
    {"gmock/", {}},
    {"benchmark/", {}},
};

const std::vector<std::string_view> kImpureHeaders = {
    "fstream", "filesystem", "iostream", "ctime",   "time.h",   "unistd.h", "fcntl.h",
    "sys/",    "linux/",     "poll.h",   "termios", "dirent.h", "csignal",  "signal.h"};

// A call: the name, not part of a longer one, then its parenthesis.
const std::regex kImpureCall(
    R"((::now|\bfopen|\bgetenv|\bsystem|\bpopen|\brandom_device|\bsleep_for|\bsleep_until|\bstd::time|\bstd::rand|\bsrand)\b)");

std::string_view part(std::string_view path, int index) {
  for (; index > 0; --index) {
    const std::size_t slash = path.find('/');
    if (slash == std::string_view::npos) return {};
    path = path.substr(slash + 1);
  }
  return path.substr(0, path.find('/'));
}

bool is_seam(std::string_view header) {
  return part(header, 0) == "drivers" && part(header, 2).empty();
}

bool plays_simulations(std::string_view path) {
  return path.starts_with("firmware/devices_in_sim.") ||
         path.starts_with("firmware/commands/sim_") ||
         path.starts_with("firmware/commands/replay_");
}

bool is_below(const std::map<std::string_view, std::vector<std::string_view>>& rooms,
              std::string_view from, std::string_view to) {
  const auto below = rooms.find(from);
  return from == to ||
         (below != rooms.end() && std::ranges::find(below->second, to) != below->second.end());
}

// Between rooms of edge/orient; paper/ stands above it and may include all.
std::string against_orient_rooms(std::string_view path, std::string_view header) {
  const std::string_view from = part(path, 2), to = part(header, 2);
  const bool from_room = !part(path, 3).empty(), to_room = !part(header, 3).empty();
  if (!to_room) {
    const bool is_type = std::ranges::find(kOrientTypes, to) != kOrientTypes.end();
    const bool above = !from_room || from == "paper";
    return above || is_type ? "" : "rooms of edge/orient include only the types of its own files";
  }
  if (from == "paper") return {};
  if (to == "paper") return "edge/orient may not include its paper";
  if (!from_room || is_below(kOrientRoomsBelow, from, to)) return {};
  return "edge/orient/" + std::string(from) + " may not include edge/orient/" + std::string(to);
}

// Empty, or why a file of edge/ may not include `header`.
std::string against_edge(std::string_view path, std::string_view header) {
  if (part(header, 0) != "edge") return "edge includes nothing of the project but edge";
  const std::string_view from = part(path, 1);
  const std::string_view to = part(header, 1);
  if (!kRoomsBelow.contains(from)) {
    return "edge/" + std::string(from) + " is new: say in tests/architecture what it may include";
  }
  if (from == "orient" && to == "orient") return against_orient_rooms(path, header);
  return is_below(kRoomsBelow, from, to)
             ? ""
             : "edge/" + std::string(from) + " may not include edge/" + std::string(to);
}

std::string against_drivers(std::string_view path, std::string_view header) {
  if (is_seam(header) || header.starts_with("edge/base/")) return {};
  const bool own = part(header, 0) == "drivers" && part(header, 1) == part(path, 1);
  return own ? "" : "drivers include only the seams drivers/*.h, edge/base and their own folder";
}

std::string against_sim(std::string_view header) {
  const std::string_view top = part(header, 0);
  const bool allowed = top == "sim" || top == "edge" || is_seam(header);
  return allowed ? "" : "sim includes only sim, edge and the seams drivers/*.h";
}

// Between rooms of firmware/, and those of the daemon, which share the folder of flights alone.
std::string against_firmware_rooms(std::string_view path, std::string_view header) {
  const std::string_view from = part(path, 1), to = part(header, 1);
  if (part(path, 2).empty()) return {};  // a program, or what ties one together
  if (part(header, 2).empty()) {
    return from == "commands" ? "" : "only programs and commands include firmware's own headers";
  }
  if (!is_below(kFirmwareRoomsBelow, from, to)) {
    return "firmware/" + std::string(from) + " may not include firmware/" + std::string(to);
  }
  const std::string_view room = part(path, 3).empty() ? "" : part(path, 2);
  const bool in_service = from == "service" && to == "service" && !room.empty();
  if (!in_service || part(header, 2) == room || part(header, 2) == "disk") return {};
  return "a room of firmware/service includes of service only itself and disk";
}

std::string against_firmware(std::string_view path, std::string_view header) {
  const std::string_view top = part(header, 0);
  if (top == "firmware") return against_firmware_rooms(path, header);
  if (top == "tests") return "nothing but tests includes tests";
  if (top == "sim" && !plays_simulations(path)) {
    return "only devices_in_sim and the sim and replay commands include sim";
  }
  if (top == "drivers" && !is_seam(header) && !path.starts_with("firmware/devices_on_board.")) {
    return "only devices_on_board includes what stands behind the seams";
  }
  return {};
}

std::string against_arrows(std::string_view path, std::string_view header) {
  const std::vector<std::string_view> tops = {"edge/", "drivers/", "sim/", "firmware/", "tests/"};
  const std::string_view top = part(path, 0);
  const bool neighbour = header.find('/') == std::string_view::npos;
  if (top == "tests" && neighbour) return {};
  if (!starts_with_any(header, tops)) return "name the header from the repository's root";
  if (top == "edge") return against_edge(path, header);
  if (top == "drivers") return against_drivers(path, header);
  if (top == "sim") return against_sim(header);
  if (top == "firmware") return against_firmware(path, header);
  return top == "tests" ? "" : "a source file lies in edge, drivers, sim, firmware or tests";
}

Violation broken(const SourceFile& file, const Include& include, const std::string& rule) {
  return {file.path, include.line, "includes " + include.header + ": " + rule};
}

}  // namespace

std::vector<Include> includes_of(std::string_view text) {
  static const std::regex pattern(R"(^\s*#\s*include\s*(["<])([^">]+)[">].*)");
  const std::string code = code_only(text);
  const std::vector<std::string_view> code_lines = lines_of(code);
  const std::vector<std::string_view> lines = lines_of(text);
  std::vector<Include> includes;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string line{lines[i]};
    std::smatch match;
    if (code_lines[i].find('#') == std::string_view::npos) continue;
    if (!std::regex_match(line, match, pattern)) continue;
    includes.push_back({match[2], match[1] == "\"", static_cast<int>(i) + 1});
  }
  return includes;
}

std::vector<Violation> wrong_arrows(const SourceFile& file) {
  std::vector<Violation> violations;
  for (const Include& include : includes_of(file.text)) {
    if (!include.quoted) continue;
    const std::string rule = against_arrows(file.path, include.header);
    if (!rule.empty()) violations.push_back(broken(file, include, rule));
  }
  return violations;
}

std::vector<Violation> strayed_libraries(const SourceFile& file) {
  std::vector<Violation> violations;
  for (const Include& include : includes_of(file.text)) {
    for (const Place& library : kLibraryPlaces) {
      const bool at_home =
          file.path.starts_with("tests/") || starts_with_any(file.path, library.places);
      if (include.header.starts_with(library.header) && !at_home) {
        violations.push_back(broken(file, include, "this library is wrapped elsewhere"));
      }
    }
  }
  return violations;
}

std::vector<Violation> impure_mathematics(const SourceFile& file) {
  if (!starts_with_any(file.path, {"edge/", "sim/"})) return {};
  if (file.path.starts_with("sim/pty_port.")) return {};  // stands in for a device of the system
  std::vector<Violation> violations;
  for (const Include& include : includes_of(file.text)) {
    if (!include.quoted && starts_with_any(include.header, kImpureHeaders)) {
      violations.push_back(broken(file, include, "edge and sim open no files and read no clocks"));
    }
  }
  const std::string code = code_only(file.text);
  const std::vector<std::string_view> lines = lines_of(code);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::match_results<std::string_view::const_iterator> match;
    if (std::regex_search(lines[i].begin(), lines[i].end(), match, kImpureCall)) {
      violations.push_back(
          {file.path, static_cast<int>(i) + 1,
           "uses " + match.str() + ": edge and sim have no files, clocks or chance"});
    }
  }
  return violations;
}

}  // namespace plumbline::architecture
