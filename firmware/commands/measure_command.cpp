// SPDX-License-Identifier: MIT
#include "firmware/commands/measure_command.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>
#include <utility>

#include "edge/survey/check_points.h"
#include "firmware/commands/adjustment_options.h"
#include "firmware/commands/geo_inputs.h"
#include "firmware/commands/measure_inputs.h"
#include "firmware/commands/run_report.h"
#include "firmware/ingest/flight_journal.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;

// result/ in a flight; plumbline-result/ beside loose photos.
fs::path default_out(const fs::path& first) {
  if (!fs::is_directory(first)) return first.parent_path() / "plumbline-result";
  return fs::is_directory(first / "photos") ? first / "result" : first / "plumbline-result";
}

deliver::Product product_of(const MeasureArguments& arguments, MeasureInputs inputs,
                            survey::Survey survey) {
  deliver::Product product;
  product.title = title_of(arguments.photos.front());
  product.problem = std::move(survey.problem);
  product.solution = std::move(survey.solution);
  product.options = arguments.options.adjustment;
  product.counts = survey.counts;
  product.counts.photos_given = inputs.photos_given;
  product.origin = geo_origin(inputs.frame);
  product.datum = arguments.datum;
  product.warnings = std::move(inputs.warnings);
  product.input_sha256 = std::move(inputs.sha256);
  return product;
}

fs::path out_of(const MeasureArguments& arguments) {
  return arguments.out.empty() ? default_out(arguments.photos.front()) : arguments.out;
}

int measure_inputs(const MeasureArguments& arguments, Result<MeasureInputs> inputs,
                   image::TieFinder& finder, RunReport& report) {
  if (!inputs) return fail(inputs.error());
  auto survey = survey::measure(inputs->survey, arguments.options, report.progress(), finder);
  if (!survey) return fail(survey.error());
  const auto known = std::move(inputs->check);
  deliver::Product product = product_of(arguments, std::move(*inputs), std::move(*survey));
  if (auto status = add_derived_figures(arguments.derived, product); !status) {
    return fail(status.error());
  }
  if (auto status = add_check(known, product); !status) return fail(status.error());
  return deliver_result(product, report, out_of(arguments), arguments.json);
}

// Measures a flight again and again while its photos come, until its recording has ended.
class FlightFollower {
 public:
  explicit FlightFollower(const MeasureArguments& arguments) : arguments_(arguments) {}

  int run() {
    const fs::path& flight = arguments_.photos.front();
    const auto journal = ingest::journal_of(flight);
    if (arguments_.photos.size() != 1 || !journal) {
      return fail({"--follow wants one flight with its recording (flight.journal)."});
    }
    int status = kGood;
    for (std::size_t measured = 0;;) {
      const bool has_ended = ended(*journal);  // before the photos: then they are all there
      const std::size_t photos = photos_in(flight / "photos");
      if (photos > std::exchange(measured, photos)) {
        status = measure();
      } else if (has_ended) {
        return status;
      } else {
        std::this_thread::sleep_for(kLookEvery);
      }
    }
  }

 private:
  static constexpr std::chrono::milliseconds kLookEvery{200};

  static bool ended(const fs::path& path) {
    const auto journal = ingest::read_flight_journal(path);
    return journal && !journal->entries.empty() &&
           std::holds_alternative<record::Ended>(journal->entries.back());
  }

  static std::size_t photos_in(const fs::path& folder) {
    std::error_code trouble;
    std::size_t count = 0;
    for (const auto& file : fs::directory_iterator(folder, trouble)) {
      count += file.path().extension() == ".jpg" ? 1 : 0;
    }
    return count;
  }

  int measure() {
    RunReport report;
    auto inputs = read_measure_inputs(arguments_, report.progress());
    if (inputs) forget_unless_first(inputs->survey.photos);
    const int status = measure_inputs(arguments_, std::move(inputs), finder_, report);
    if (status != kGood) return status;
    std::cout << "Measured from " << names_.size()
              << " photos: " << (out_of(arguments_) / "report.html").string() << ".\n"
              << std::flush;
    return status;
  }

  // What is known of the photos before holds where they are the first of these.
  void forget_unless_first(const std::vector<orient::Photo>& photos) {
    std::vector<std::string> names;
    for (const auto& photo : photos) names.push_back(photo.name);
    const bool first =
        names.size() >= names_.size() && std::equal(names_.begin(), names_.end(), names.begin());
    if (!first) finder_ = image::TieFinder();
    names_ = std::move(names);
  }

  const MeasureArguments& arguments_;
  image::TieFinder finder_;
  std::vector<std::string> names_;  // of the photos that it knows
};

int run_measure(MeasureArguments arguments) {
  if (arguments.threads == 0) {
    arguments.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  }
  arguments.options.ties.threads = arguments.threads;
  if (arguments.follow) return FlightFollower(arguments).run();
  RunReport report;
  image::TieFinder finder;
  return measure_inputs(arguments, read_measure_inputs(arguments, report.progress()), finder,
                        report);
}

void add_known_options(CLI::App& sub, MeasureArguments& a) {
  sub.add_option("--picks", a.picks,
                 "CSV photo,point,u_px,v_px[,sigma_px]: points measured by hand; a point picked in "
                 "one photo is found in the others");
  sub.add_option("--length", a.lengths, "a known length between picks: A,B,METRES[,SIGMA]")
      ->take_all()
      ->allow_extra_args(false);
  sub.add_option("--control", a.control, "CSV of known points, used in the adjustment");
  sub.add_option("--check", a.check, "CSV of known points, compared and never used");
}

void add_gnss_options(CLI::App& sub, MeasureArguments& a) {
  sub.add_option("--gnss", a.gnss,
                 "receiver log for the positions: NMEA, RTKLIB .llh or .pos, or events .pos");
  sub.add_option("--time-offset", a.time_offset,
                 "GNSS time minus the camera's clock, seconds: S[,SIGMA]");
  sub.add_option("--lever-arm", a.lever_arm, "antenna minus camera, metres: R,U,B[,SIGMA]");
  sub.add_option("--lever-frame", a.lever_frame, "frame of the lever arm: photo or body")
      ->check(CLI::IsMember({"photo", "body"}))
      ->capture_default_str();
  sub.add_option("--photo-heights", a.photo_heights,
                 "what the heights in the photos are above: ellipsoidal, egm96, or the name of "
                 "--geoid's model");
  sub.add_option("--geoid", a.geoid, "geoid model for orthometric heights: .pgm or ISG text");
  sub.add_option("--datum", a.datum, "name of the datum, written into the results")
      ->capture_default_str();
}

}  // namespace

void add_measure(CLI::App& app, int& status) {
  auto a = std::make_shared<MeasureArguments>();
  CLI::App* sub = app.add_subcommand("measure", "from photos to ground points with error bars");
  sub->add_option("PHOTOS", a->photos, "photos, folders of photos, or a flight")->required();
  sub->add_option("--out", a->out,
                  "folder for the results (default: result/ in a flight, plumbline-result/ beside "
                  "loose photos)");
  sub->add_option("--camera", a->camera, "camera.toml (default: the flight's, else from EXIF)");
  add_known_options(*sub, *a);
  add_gnss_options(*sub, *a);
  sub->add_option("--ties", a->options.ties.ties_wanted, "tie points wanted")
      ->check(CLI::Range(50, 100000))
      ->capture_default_str();
  auto* ties_from = sub->add_option("--ties-from", a->ties_from,
                                    "an earlier result of these photos: its tie points, instead of "
                                    "finding them anew");
  sub->add_option("--threads", a->threads, "0: as many as the machine has")
      ->check(CLI::Range(0, 256));
  sub->add_flag("--follow", a->follow,
                "of a flight that is being flown: measure as photos come, until it has ended")
      ->excludes(ties_from);
  sub->add_flag("--json", a->json, "print summary.json instead of the table");
  add_derived_options(*sub, a->derived);
  add_adjustment_options(*sub, a->options.adjustment);
  sub->footer(
      "Example: plumbline measure photos/ --out result/\n"
      "         plumbline measure flight/ --picks picks.csv --check check.csv\n"
      "         plumbline measure photos/ --picks picks.csv --length A,B,14.831");
  sub->callback([a, &status] { status = run_measure(*a); });
}

}  // namespace plumbline::commands
