// SPDX-License-Identifier: MIT
#include "firmware/config/make_key.h"
#include "firmware/config/places.h"
#include "firmware/config/section_keys.h"

namespace plumbline::config {
namespace {

constexpr const char* kPath = "a path that begins with / and does not end with it";

std::vector<Key> recording_keys() {
  return {
      text({"recording", "folder",
            "Flights are recorded here, each in a folder of its own. The usual one is made where "
            "it is missing; another has to be there, so that a disk that is not mounted is "
            "noticed."},
           kPath, is_absolute_path, PLUMBLINE_FIELD(recording.folder)),
      number({"recording", "keep_free_mb",
              "Room that photos are not to need: with too little besides, it is not ready."},
             kMegabytes, {1, 10'000'000}, PLUMBLINE_FIELD(recording.keep_free_mb)),
      yes_or_no({"recording", "clean_results",
                 "The oldest results (never photos, never journals) are removed to make room."},
                PLUMBLINE_FIELD(recording.clean_results)),
  };
}

std::vector<Key> advice_keys() {
  return {
      yes_or_no({"advice", "enabled", "Tell after each photo what is known, and where to fly."},
                PLUMBLINE_FIELD(advice.enabled)),
      number({"advice", "goal_m", "The sigma to reach, in plan and height."}, kMetres, {0.001, 10},
             PLUMBLINE_FIELD(advice.goal_m)),
  };
}

std::vector<Key> measure_keys() {
  return {
      yes_or_no({"measure", "enabled",
                 "Measure the flight while it is flown; at the start the last one, where it has no "
                 "result yet."},
                PLUMBLINE_FIELD(measure.enabled)),
      number({"measure", "memory_mb", "How much memory the measuring program may take."},
             kMegabytes, {100, 1'000'000}, PLUMBLINE_FIELD(measure.memory_mb)),
      number({"measure", "seconds",
              "How long the measuring program may work on photos that came, or at the end of a "
              "flight."},
             kSeconds, {10, 86'400}, PLUMBLINE_FIELD(measure.longest)),
      text(
          {"measure", "command",
           "\"\" starts plumbline measure; \"request\" writes the flight's path to measure.request "
           "in the folder of the flights, for a service (a path unit of systemd's) that runs "
           "plumbline measure on it and leaves its result in the flight."},
          R"("" or "request")",
          [](const std::string& word) { return word.empty() || word == "request"; },
          PLUMBLINE_FIELD(measure.command)),
  };
}

std::vector<Key> status_keys() {
  return {
      text({"status", "file",
            "For other programs: JSON, replaced as a whole at each change and every second, with "
            "time and pid. After a clean stop its phase is \"stopped\"; where time is older than "
            "a few seconds, the daemon was killed."},
           kPath, is_absolute_path, PLUMBLINE_FIELD(status.file)),
      text({"status", "socket",
            "What plumbline status reads: the same JSON, an object a line, on a local socket."},
           "a path of at most 107 bytes that begins with /", is_socket_path,
           PLUMBLINE_FIELD(status.socket)),
  };
}

}  // namespace

std::vector<Key> house_keys() {
  std::vector<Key> all = recording_keys();
  for (const auto& part : {advice_keys(), measure_keys(), status_keys()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace plumbline::config
