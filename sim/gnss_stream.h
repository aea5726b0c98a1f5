// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/gnss_fix.h"
#include "edge/geodesy/local_frame.h"
#include "sim/gnss_error.h"
#include "sim/line_piece.h"
#include "sim/random.h"

namespace plumbline::sim {

// What goes wrong between two times, in seconds of UTC since the stream began.
struct GnssFault {
  enum class Kind {
    kSilent,     // nothing is sent
    kNoFix,      // no position, quality 0
    kFloat,      // quality 5: an error of decimetres, and sigmas that say so
    kFalseFix,   // quality 4 and small sigmas, and an offset that nothing tells of
    kGarbage,    // bytes without meaning instead of sentences
    kWrongDigit  // one digit of each burst became another on the way
  };

  double from_s = 0;
  double until_s = 0;
  Kind kind = Kind::kSilent;
  std::array<double, 3> offset_enu_m{};  // of kFalseFix
};

struct GnssStreamOptions {
  bool llh = false;                         // RTKLIB's lines instead of NMEA
  std::chrono::milliseconds interval{200};  // of GGA or LLH; GST and RMC come once a second
  std::chrono::nanoseconds least_latency = std::chrono::milliseconds(80);
  std::chrono::nanoseconds latency_jitter = std::chrono::milliseconds(15);  // mean, exponential
  int baud = 115200;                                                        // ten bits a byte
  std::size_t bytes_per_piece = 64;                                         // as reads bring them
  SigmaPair fixed_sigma{0.010, 0.020};
  SigmaPair float_sigma{0.30, 0.60};
  double separation_m = 38.123;  // of geoid and ellipsoid
  HostTime host_at_start;        // when UTC was `utc_at_start`
  UtcTime utc_at_start =
      std::chrono::sys_days(std::chrono::year(2026) / 11 / 20) + std::chrono::hours(10);
  double host_rate_error = 0;  // 50e-6: the host's clock runs 50 ppm fast
  std::vector<GnssFault> faults;
};

// What a receiver sends in the manner of Emlid's, piece by piece at the times of arrival, for an
// antenna that is at path(seconds of UTC since the start). Endless; the same seed gives the same
// bytes.
class GnssStream {
 public:
  using Path = std::function<geodesy::Geodetic(double seconds)>;

  GnssStream(Path path, GnssStreamOptions options, std::uint64_t seed);

  LinePiece next();

  HostTime host_of(UtcTime utc) const;

 private:
  struct Epoch;

  void send_epoch();
  Epoch epoch_at(UtcTime utc);
  std::string burst_of(const Epoch& epoch);
  void put_on_line(UtcTime utc, const std::string& burst);
  const GnssFault* fault_at(double seconds, GnssFault::Kind kind) const;
  std::string garbage(std::size_t size);
  void spoil_a_digit(std::string& burst);

  Path path_;
  GnssStreamOptions options_;
  Random random_;
  int epochs_ = 0;
  HostTime line_free_;
  std::deque<LinePiece> pieces_;
};

}  // namespace plumbline::sim
