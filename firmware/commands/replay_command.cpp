// SPDX-License-Identifier: MIT
#include "firmware/commands/replay_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "edge/capture/decider.h"
#include "firmware/commands/journal_text.h"
#include "firmware/commands/recording_state.h"
#include "firmware/commands/run_report.h"
#include "firmware/config/config_toml.h"
#include "firmware/ingest/flight_journal.h"
#include "firmware/ingest/number.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;

struct ReplayArguments {
  fs::path flight;
  double speed = 0;
  fs::path out;
  bool json = false;
};

struct ReplayResult {
  record::JournalSummary journal;
  std::uint64_t inputs = 0;
  std::uint64_t decisions = 0;           // made again
  std::uint64_t as_flown = 0;            // of those
  std::uint64_t unrecorded = 0;          // made now, after the end of a cut recording
  std::vector<std::string> differences;  // the first few, in words
  std::vector<capture::Decision> made;
};

std::string bytes_of(const capture::Decision& decision) {
  std::string bytes;
  record::pack(decision, bytes);
  return bytes;
}

// Plays the inputs through the deciding code, and holds what comes out against what was recorded.
class Replayer {
 public:
  explicit Replayer(double speed) : speed_(speed) {}

  Status take(const record::Entry& entry) {
    if (const auto* began = std::get_if<record::Began>(&entry)) return begin(*began);
    if (const auto* input = std::get_if<capture::Input>(&entry)) {
      hear(*input);
    } else if (const auto* decision = std::get_if<capture::Decision>(&entry)) {
      compare(*decision);
    }
    return Done{};
  }

  ReplayResult finish() {
    result_.unrecorded = open_.size();
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kShown = 5;

  Status begin(const record::Began& began) {
    const auto reading = config::parse_config(began.configuration, "configuration of the flight");
    if (!reading.errors.empty()) return reading.errors.front();
    decider_ = std::make_unique<capture::Decider>(reading.config.capture);
    open_.clear();  // what the program had decided when it was stopped was not recorded
    return Done{};
  }

  void hear(const capture::Input& input) {
    if (!decider_) return;
    pace(input.now);
    for (const auto& decision : open_) differ(decision, "was not decided in flight");
    open_.clear();
    ++result_.inputs;
    decider_->take(input, open_);
    result_.decisions += open_.size();
    result_.made.insert(result_.made.end(), open_.begin(), open_.end());
  }

  void compare(const capture::Decision& flown) {
    if (!decider_) return;
    if (!open_.empty() && bytes_of(open_.front()) == bytes_of(flown)) {
      ++result_.as_flown;
      open_.erase(open_.begin());
      return;
    }
    differ(flown, "was decided in flight, and is not now");
    if (!open_.empty()) open_.erase(open_.begin());
  }

  void differ(const capture::Decision& decision, const std::string& how) {
    if (result_.differences.size() < kShown) {
      result_.differences.push_back(text_of(record::Entry(decision)) + " " + how);
    }
    ++differing_;
  }

  void pace(HostTime now) {
    if (speed_ <= 0) return;
    if (now > last_ && last_ != HostTime{}) {
      std::this_thread::sleep_for((now - last_) / speed_);
    }
    last_ = std::max(last_, now);
  }

  double speed_;
  HostTime last_;
  std::unique_ptr<capture::Decider> decider_;
  std::vector<capture::Decision> open_;  // made now, and not yet met in the recording
  std::uint64_t differing_ = 0;
  ReplayResult result_;
};

Status write_decisions(const fs::path& folder, const ReplayResult& result) {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path path = folder / "decisions.txt";
  std::ofstream file(path);
  for (const auto& decision : result.made) file << text_of(record::Entry(decision)) << '\n';
  file.close();
  if (file) return Done{};
  return Error{"Cannot write " + path.string() + ": is there space, and the right to write?"};
}

void print(const ReplayResult& result) {
  const std::string trouble = trouble_with(result.journal);
  if (!trouble.empty()) std::printf("%s\n", trouble.c_str());
  std::printf("%llu inputs, %llu decisions, %llu of them as flown\n",
              static_cast<unsigned long long>(result.inputs),
              static_cast<unsigned long long>(result.decisions),
              static_cast<unsigned long long>(result.as_flown));
  if (result.unrecorded > 0) {
    std::printf("%llu decisions follow from the last input of a recording that was cut.\n",
                static_cast<unsigned long long>(result.unrecorded));
  }
  for (const std::string& difference : result.differences) std::printf("%s\n", difference.c_str());
}

int run_replay(const ReplayArguments& arguments) {
  const auto path = ingest::journal_of(arguments.flight);
  if (!path) {
    return fail(
        {arguments.flight.string() + " holds no flight.journal: give the folder of one flight."});
  }
  const auto journal = ingest::read_flight_journal(*path);
  if (!journal) return fail(journal.error());
  Replayer replayer(arguments.speed);
  for (const auto& entry : journal->entries) {
    if (const Status taken = replayer.take(entry); !taken) return fail(taken.error());
  }
  ReplayResult result = replayer.finish();
  result.journal = journal->summary;
  if (!arguments.out.empty()) {
    if (const Status written = write_decisions(arguments.out, result); !written) {
      return fail(written.error());
    }
  }
  if (arguments.json) {
    const nlohmann::ordered_json json = {
        {"state", name_of(result.journal.state)}, {"inputs", result.inputs},
        {"decisions", result.decisions},          {"as_flown", result.as_flown},
        {"unrecorded", result.unrecorded},        {"differences", result.differences}};
    std::printf("%s\n", json.dump(2).c_str());
  } else {
    print(result);
  }
  const bool is_whole = result.journal.state == record::JournalState::kComplete;
  return is_whole && result.differences.empty() ? kGood : kWorkFailed;
}

// Empty for a good one, else a sentence.
std::string check_speed(const std::string& text) {
  constexpr double kSlowest = 0.01, kFastest = 1e6;
  const auto speed = ingest::parse_number(text);
  if (speed && (*speed == 0 || (*speed >= kSlowest && *speed <= kFastest))) return "";
  return "'" + text +
         "' is no speed: give 0 (as fast as it goes), or a number from 0.01 to 1000000 (2 is twice "
         "as fast as flown)";
}

}  // namespace

void add_replay(CLI::App& app, int& status) {
  auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = app.add_subcommand(
      "replay", "The daemon's own code over a recording; decisions compared with those flown.");
  command->add_option("flight", arguments->flight, "the flight's folder")->required();
  command->add_option("--speed", arguments->speed, "times as fast as flown; 0: as fast as it goes")
      ->check(check_speed)
      ->capture_default_str();
  command->add_option("--out", arguments->out, "folder for decisions.txt");
  command->add_flag("--json", arguments->json, "one object");
  command->footer(
      "Ends with status 0 only where the recording is complete and every decision as flown, bit "
      "for "
      "bit. What\n"
      "is whole of a cut or damaged one is played all the same.\n"
      "Example: plumbline replay /var/lib/plumbline/flights/0007 --speed 0");
  command->callback([arguments, &status] { status = run_replay(*arguments); });
}

}  // namespace plumbline::commands
