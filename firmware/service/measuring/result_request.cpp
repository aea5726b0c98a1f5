// SPDX-License-Identifier: MIT
#include "firmware/service/measuring/result_request.h"

#include <sys/stat.h>

#include <fstream>

namespace plumbline::service {
namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;

}  // namespace

ResultRequest::Stamp ResultRequest::stamp_of(const std::string& flight) {
  struct stat found {};
  if (::stat((flight + "/result/summary.json").c_str(), &found) != 0) return std::nullopt;
  return std::pair(found.st_ino, found.st_mtim.tv_sec * kNanoseconds + found.st_mtim.tv_nsec);
}

bool ResultRequest::ask(const std::string& flight, int photos, Time now) {
  if (flight != flight_) seen_ = stamp_of(flight);
  if (!is_open_ || flight != flight_) asked_ = now;
  std::ofstream file(file_, std::ios::trunc);
  file << flight << '\n';
  file.close();
  is_open_ = file.good();
  flight_ = flight;
  photos_ = photos;
  return is_open_;
}

std::optional<ResultRequest::Answer> ResultRequest::answer(Time now) {
  if (!is_open_) return std::nullopt;
  const Stamp found = stamp_of(flight_);
  if (found && found != seen_) {
    seen_ = found;
    asked_ = now;
    Answer read_now = read();
    is_open_ = !read_now.is_last;
    return read_now;
  }
  if (now <= asked_ + longest_) return std::nullopt;
  is_open_ = false;
  return Answer{false, false,
                "No result came within " + std::to_string(longest_.count()) +
                    " s of the request in " + file_ +
                    ": is the package plumbline installed, which measures? Where nothing is to be "
                    "measured, set measure.enabled = false. The photos are kept.",
                std::nullopt};
}

ResultRequest::Answer ResultRequest::read() const {
  const std::string result = flight_ + "/result";
  Answer answer;
  answer.figures = read_result(result);
  answer.is_last = !answer.figures || answer.figures->photos_given >= photos_;
  const std::string report = result + "/report.html";
  if (answer.figures && !answer.figures->converged) {
    answer.good = false;
    answer.sentence = "The adjustment did not converge, and its result must not be used: " + report;
  } else if (answer.figures) {
    answer.sentence =
        "Measured from " + std::to_string(answer.figures->photos_given) + " photos: " + report;
  } else {
    answer.sentence = "Measured: " + report;
  }
  answer.sentence += ".";
  return answer;
}

}  // namespace plumbline::service
