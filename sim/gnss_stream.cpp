// SPDX-License-Identifier: MIT
#include "sim/gnss_stream.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/gnss_sentences.h"

namespace plumbline::sim {
namespace {

using std::chrono::nanoseconds;
using Kind = GnssFault::Kind;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

geodesy::Geodetic moved(const geodesy::Geodetic& place, const Eigen::Vector3d& by_enu_m) {
  return geodesy::LocalFrame::at(place).value().geodetic_of(by_enu_m);
}

}  // namespace

struct GnssStream::Epoch {
  double seconds = 0;
  bool whole_second = false;
  SaidEpoch said;
};

GnssStream::GnssStream(Path path, GnssStreamOptions options, std::uint64_t seed)
    : path_(std::move(path)), options_(std::move(options)), random_(seed, 1) {
  pieces_.push_back({options_.host_at_start, LinePiece::Kind::kPluggedIn, {}});
  if (options_.llh) {
    pieces_.push_back({options_.host_at_start, LinePiece::Kind::kBytes, llh_header()});
  }
  line_free_ = options_.host_at_start;
}

LinePiece GnssStream::next() {
  while (pieces_.empty()) send_epoch();
  LinePiece piece = std::move(pieces_.front());
  pieces_.pop_front();
  return piece;
}

HostTime GnssStream::host_of(UtcTime utc) const {
  const nanoseconds since = utc - options_.utc_at_start;
  const auto gained =
      static_cast<nanoseconds::rep>(static_cast<double>(since.count()) * options_.host_rate_error);
  return options_.host_at_start + since + nanoseconds(gained);
}

void GnssStream::send_epoch() {
  const UtcTime utc = options_.utc_at_start + epochs_ * options_.interval;
  ++epochs_;
  const Epoch epoch = epoch_at(utc);
  if (fault_at(epoch.seconds, Kind::kSilent) != nullptr) return;
  std::string burst = burst_of(epoch);
  if (fault_at(epoch.seconds, Kind::kGarbage) != nullptr) burst = garbage(burst.size());
  if (fault_at(epoch.seconds, Kind::kWrongDigit) != nullptr) spoil_a_digit(burst);
  put_on_line(utc, burst);
}

GnssStream::Epoch GnssStream::epoch_at(UtcTime utc) {
  Epoch epoch;
  epoch.seconds = std::chrono::duration<double>(utc - options_.utc_at_start).count();
  epoch.whole_second = utc == std::chrono::floor<std::chrono::seconds>(utc);
  const bool is_float = fault_at(epoch.seconds, Kind::kFloat) != nullptr;
  epoch.said.utc = utc;
  epoch.said.quality = is_float ? FixQuality::kFloat : FixQuality::kFixed;
  epoch.said.separation_m = options_.separation_m;
  epoch.said.sigma = is_float ? options_.float_sigma : options_.fixed_sigma;
  Eigen::Vector3d error_m(random_.normal(), random_.normal(), random_.normal());
  error_m = error_m.cwiseProduct(epoch.said.sigma.per_axis());
  if (const GnssFault* fault = fault_at(epoch.seconds, Kind::kFalseFix)) {
    error_m += Eigen::Vector3d::Map(fault->offset_enu_m.data());
  }
  epoch.said.place = moved(path_(epoch.seconds), error_m);
  if (fault_at(epoch.seconds, Kind::kNoFix) != nullptr) epoch.said.quality = FixQuality::kNone;
  return epoch;
}

std::string GnssStream::burst_of(const Epoch& epoch) {
  if (options_.llh) return llh_of(epoch.said);
  std::string burst;
  if (epoch.whole_second) burst += rmc_of(epoch.said);
  burst += gga_of(epoch.said);
  if (epoch.whole_second) burst += gst_of(epoch.said);
  return burst;
}

// A line that is slower than what is sent falls behind, as a real one does.
void GnssStream::put_on_line(UtcTime utc, const std::string& burst) {
  const double late = -std::log(1 - random_.uniform());
  const auto jitter =
      static_cast<nanoseconds::rep>(late * static_cast<double>(options_.latency_jitter.count()));
  HostTime time = std::max(line_free_, host_of(utc) + options_.least_latency + nanoseconds(jitter));
  for (std::size_t at = 0; at < burst.size(); at += options_.bytes_per_piece) {
    const std::string bytes = burst.substr(at, options_.bytes_per_piece);
    time += nanoseconds(10'000'000'000LL * static_cast<long long>(bytes.size()) / options_.baud);
    pieces_.push_back({time, LinePiece::Kind::kBytes, bytes});
  }
  line_free_ = time;
}

const GnssFault* GnssStream::fault_at(double seconds, Kind kind) const {
  const auto fault =
      std::find_if(options_.faults.begin(), options_.faults.end(), [&](const GnssFault& f) {
        return f.kind == kind && seconds >= f.from_s && seconds < f.until_s;
      });
  return fault == options_.faults.end() ? nullptr : &*fault;
}

std::string GnssStream::garbage(std::size_t size) {
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random_.next() & 0xFF);
  return bytes;
}

void GnssStream::spoil_a_digit(std::string& burst) {
  if (burst.empty()) return;
  const auto start =
      static_cast<std::size_t>(random_.uniform() * static_cast<double>(burst.size()));
  const auto digit =
      std::find_if(burst.begin() + static_cast<std::ptrdiff_t>(start), burst.end(), is_digit);
  if (digit != burst.end()) *digit = static_cast<char>('0' + (*digit - '0' + 1) % 10);
}

}  // namespace plumbline::sim
