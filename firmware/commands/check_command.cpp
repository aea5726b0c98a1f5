// SPDX-License-Identifier: MIT
#include "firmware/commands/check_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "edge/record/sha256.h"
#include "firmware/commands/journal_text.h"
#include "firmware/commands/recording_state.h"
#include "firmware/commands/run_report.h"
#include "firmware/ingest/file_hash.h"
#include "firmware/ingest/flight_journal.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;

struct CheckArguments {
  fs::path flight;
  bool dump = false;
  bool json = false;
};

// What a flight's folder holds, beside what its journal says of it.
struct Findings {
  record::JournalSummary journal;
  std::vector<std::string> broken_photos;   // sentences
  std::vector<std::string> unnamed_photos;  // on the disk, not in the journal
  int stored = 0, taken = 0, missed = 0, fixes = 0, faults = 0, starts = 0;
  double duration_s = 0;
  bool flown = false;
  bool landed = false;                  // after that
  std::vector<std::string> not_stored;  // photos taken that never reached the disk
  std::map<int, double> left_m;         // heights gone by without a photo, by number in the plan
};

std::string trouble_with_photo(const fs::path& flight, const record::Stored& stored) {
  std::error_code error;
  const fs::path path = flight / stored.name;
  if (!fs::is_regular_file(path, error)) return stored.name + " is missing.";
  if (fs::file_size(path, error) != stored.length) {
    return stored.name + " has " + std::to_string(fs::file_size(path, error)) + " bytes, not the " +
           std::to_string(stored.length) + " that were stored.";
  }
  const auto hash = ingest::sha256_of_file(path);
  if (!hash) return hash.error().sentence;
  return *hash == record::in_hex(stored.sha256) ? "" : stored.name + " is not what was stored.";
}

class Count {
 public:
  Count(const fs::path& flight, Findings& findings) : flight_(flight), findings_(findings) {}

  void operator()(const record::Began& began) {
    ++findings_.starts;
    if (!began.boot.empty() && began.boot == boot_) return;
    boot_ = began.boot;  // whose clock is another
    before_s_ = findings_.duration_s;
    first_.reset();
  }
  void operator()(const record::Bytes&) {}
  void operator()(const PilotAttitude&) {}
  void operator()(const PilotPosition&) {}
  void operator()(const record::Ended&) {}
  void operator()(const record::Message& message) {
    if (message.severity == record::Severity::kFault) ++findings_.faults;
  }
  void operator()(const record::Stored& stored) {
    ++findings_.stored;
    stored_.insert(stored.number);
    const std::string trouble = trouble_with_photo(flight_, stored);
    if (!trouble.empty()) findings_.broken_photos.push_back(trouble);
  }
  void operator()(const capture::Input& input) {
    if (std::holds_alternative<capture::FixHeard>(input.what)) ++findings_.fixes;
    if (!first_) first_ = input.now;
    findings_.duration_s = before_s_ + std::chrono::duration<double>(input.now - *first_).count();
  }
  void operator()(const capture::Decision& decision) {
    if (const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what)) {
      ++findings_.taken;
      findings_.left_m.erase(taken->target.entry);
      if (taken->frame) taken_.insert(taken->number);
    }
    if (std::holds_alternative<capture::PhotoMissed>(decision.what)) ++findings_.missed;
    if (const auto* passed = std::get_if<capture::HeightPassed>(&decision.what)) {
      findings_.left_m[passed->target.entry] = passed->target.height_m;
    }
    const auto* changed = std::get_if<capture::PhaseChanged>(&decision.what);
    if (changed == nullptr) return;
    const bool is_flying = changed->phase == capture::Phase::kFlying;
    if (is_flying) findings_.flown = true;
    if (is_flying || changed->phase == capture::Phase::kLanded) findings_.landed = !is_flying;
  }

  void finish() {
    for (const int number : taken_) {
      if (!stored_.contains(number)) findings_.not_stored.push_back(std::to_string(number));
    }
    std::error_code error;
    for (const auto& file : fs::directory_iterator(flight_ / "photos", error)) {
      int number = 0;
      std::sscanf(file.path().filename().c_str(), "%d", &number);
      if (!stored_.contains(number)) {
        findings_.unnamed_photos.push_back("photos/" + file.path().filename().string());
      }
    }
    std::sort(findings_.unnamed_photos.begin(), findings_.unnamed_photos.end());
  }

 private:
  const fs::path& flight_;
  Findings& findings_;
  std::set<int> stored_;
  std::set<int> taken_;
  std::optional<HostTime> first_;  // of this boot
  std::string boot_;
  double before_s_ = 0;
};

std::string state_of(const Findings& findings) {
  return findings.broken_photos.empty() ? name_of(findings.journal.state) : "damaged";
}

std::string sentence_of(const Findings& findings) {
  const std::string trouble = trouble_with(findings.journal);
  const std::size_t broken = findings.broken_photos.size();
  if (broken == 0) return trouble.empty() ? "The recording is complete." : trouble;
  const std::string photos =
      broken == 1 ? "1 photo is not whole." : std::to_string(broken) + " photos are not whole.";
  if (findings.journal.state == record::JournalState::kDamaged) return trouble + " " + photos;
  return "The recording is damaged: " + photos + (trouble.empty() ? "" : " " + trouble);
}

// Whether the drone flew, and came down again.
std::string flight_of(const Findings& f) {
  if (!f.flown) return "no take-off recorded";
  return f.landed ? "flown and landed" : "flown, and no landing recorded";
}

std::string photos_of(const Findings& f) {
  if (f.taken == 0 && f.missed == 0 && f.stored == 0) return "No photo was taken";
  return std::to_string(f.taken) + " photos taken, " + std::to_string(f.stored) + " stored, " +
         std::to_string(f.missed) + " missed";
}

std::vector<double> heights_left_m(const Findings& f) {
  std::vector<double> heights_m;
  for (const auto& [entry, height_m] : f.left_m) heights_m.push_back(height_m);
  return heights_m;
}

nlohmann::ordered_json json_of(const Findings& f) {
  return {{"state", state_of(f)},
          {"entries", f.journal.entries},
          {"whole_bytes", f.journal.whole_bytes},
          {"skipped_bytes", f.journal.skipped_bytes},
          {"tail_bytes", f.journal.tail_bytes},
          {"lost_entries", f.journal.lost_entries},
          {"starts", f.starts},
          {"duration_s", f.duration_s},
          {"flown", f.flown},
          {"landed", f.landed},
          {"fixes", f.fixes},
          {"photos_taken", f.taken},
          {"photos_stored", f.stored},
          {"photos_missed", f.missed},
          {"faults", f.faults},
          {"heights_without_photo_m", heights_left_m(f)},
          {"not_stored", f.not_stored},
          {"broken_photos", f.broken_photos},
          {"unnamed_photos", f.unnamed_photos}};
}

void print(const Findings& f) {
  std::printf("%s\n", sentence_of(f).c_str());
  std::printf("%llu entries, %.1f s, %d fixes, %d start%s of the program, %s\n",
              static_cast<unsigned long long>(f.journal.entries), f.duration_s, f.fixes, f.starts,
              f.starts == 1 ? "" : "s", flight_of(f).c_str());
  std::printf("%s, %d faults\n", photos_of(f).c_str(), f.faults);
  for (const double height_m : heights_left_m(f)) {
    std::printf("No photo at %g m: the drone went by.\n", height_m);
  }
  for (const std::string& sentence : f.broken_photos) std::printf("%s\n", sentence.c_str());
  for (const std::string& number : f.not_stored) {
    std::printf("Photo %s was taken, and never reached the disk.\n", number.c_str());
  }
  for (const std::string& name : f.unnamed_photos) {
    std::printf("%s is not named in the journal.\n", name.c_str());
  }
}

int run_check(const CheckArguments& arguments) {
  const auto path = ingest::journal_of(arguments.flight);
  if (!path) {
    return fail(
        {arguments.flight.string() + " holds no flight.journal: give the folder of one flight."});
  }
  const auto journal = ingest::read_flight_journal(*path);
  if (!journal) return fail(journal.error());
  if (arguments.dump) {
    for (const auto& entry : journal->entries) std::printf("%s\n", text_of(entry).c_str());
  }
  Findings findings;
  findings.journal = journal->summary;
  Count count(arguments.flight, findings);
  for (const auto& entry : journal->entries) std::visit(count, entry);
  count.finish();
  if (arguments.json) std::printf("%s\n", json_of(findings).dump(2).c_str());
  if (!arguments.json && !arguments.dump) print(findings);
  if (arguments.dump) std::fprintf(stderr, "%s\n", sentence_of(findings).c_str());
  return state_of(findings) == "complete" ? kGood : kWorkFailed;
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Is the recording of a flight complete, truncated or damaged; what is in it.");
  command->add_option("flight", arguments->flight, "the flight's folder")->required();
  command->add_flag("--dump", arguments->dump, "every entry of the journal, a line each");
  command->add_flag("--json", arguments->json, "one object");
  command->footer(
      "Ends with status 0 only where the recording is complete and every photo whole.\n"
      "With --dump, age_s of a photo is that of the receiver's newest position at the exposure; "
      "below 0, that\n"
      "position is from after the exposure, and the photo's place lies between two.\n"
      "Example: plumbline check /var/lib/plumbline/flights/0007");
  command->callback([arguments, &status] { status = run_check(*arguments); });
}

}  // namespace plumbline::commands
