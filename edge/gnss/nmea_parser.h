// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <string_view>

#include "edge/base/gnss_fix.h"
#include "edge/gnss/nmea_framer.h"
#include "edge/gnss/nmea_sentences.h"

namespace plumbline::gnss {

struct NmeaOptions {
  // Receivers send GST more seldom than GGA (Reach: 1 Hz against 5 Hz). A GST serves the epochs
  // after its own for so long, as long as the quality stays what it was.
  std::chrono::microseconds gst_hold = std::chrono::seconds(2);
};

// NMEA 0183 bytes in, fixes out: GGA, GNS, RMC, GST, ZDA, VTG and Reach's EBP, of any talker.
// Knows no port, clock or thread.
//
// All sentences of one time of day make one epoch, in any order; it is handed out when a sentence
// of another time begins, or at flush(); what comes later of a time that was flushed adds nothing.
// Its position is that of GGA, else of GNS; RMC stands in (without height) only until the first GGA
// or GNS was heard. Height above the ellipsoid is altitude + separation, to the digit. Sigmas come
// from the GST of that time or a held one. The date comes from RMC (status A) or ZDA and is carried
// on, across midnight too. An epoch of quality 0 has no position, whatever stands in its fields.
class NmeaParser {
 public:
  using Sink = std::function<void(const GnssFix&)>;

  explicit NmeaParser(Sink sink, NmeaOptions options = {});
  NmeaParser(const NmeaParser&) = delete;  // its framer calls back into it
  NmeaParser& operator=(const NmeaParser&) = delete;

  void feed(std::string_view bytes) { framer_.feed(bytes); }
  void flush();   // hands out the epoch begun: the burst is over
  void finish();  // the input ends here

  // Of the epoch being handed out: from the '$' of its first sentence to the end of its last.
  ByteRange epoch_bytes() const { return epoch_bytes_; }

  const DecoderCounters& counters() const { return framer_.counters(); }
  const std::optional<BasePosition>& base() const { return base_; }
  const std::optional<GroundVelocity>& ground_velocity() const { return ground_velocity_; }

 private:
  struct Epoch {
    std::optional<TimeOfDay> time_of_day;
    std::optional<Gga> gga;
    std::optional<Gga> gns;
    std::optional<Rmc> rmc;
    ByteRange bytes;
  };
  // The first sentence of a time that no epoch has begun with yet.
  struct Herald {
    TimeOfDay time_of_day{};
    std::uint64_t begin = 0;
  };
  struct HeldGst {
    TimeOfDay time_of_day{};
    Eigen::Matrix3d covariance_enu_m2;
    std::optional<FixQuality> quality;  // of the epoch it belongs to
  };

  bool take(std::string_view body);
  bool take_place(std::string_view type, const Fields& fields);
  bool take_gst(const Fields& fields);
  bool take_zda(const Fields& fields);
  bool take_vtg(const Fields& fields);
  bool take_ebp(const Fields& fields);

  void note_time(const std::optional<TimeOfDay>& time);
  Fields split_fields(std::string_view text);
  bool is_late(const std::optional<TimeOfDay>& time) const;
  std::uint64_t first_byte_of(const std::optional<TimeOfDay>& time) const;
  template <typename Sentence>
  bool join(std::optional<Sentence> sentence, std::optional<Sentence> Epoch::*slot);
  void learn_date(const std::optional<TimeOfDay>& time, std::optional<std::chrono::sys_days> date);
  void close();
  GnssFix fix_of(const Epoch& epoch) const;
  std::optional<UtcTime> resolve(const std::optional<TimeOfDay>& time);
  std::optional<Eigen::Matrix3d> covariance_for(const GnssFix& fix);

  Sink sink_;
  NmeaOptions options_;
  NmeaFramer framer_;
  std::array<std::string_view, 256> fields_;  // of the sentence at hand
  std::optional<Epoch> epoch_;
  std::optional<TimeOfDay> flushed_;  // the time of an epoch that was not closed by another
  std::optional<Herald> herald_;
  ByteRange epoch_bytes_;
  bool gga_or_gns_heard_ = false;
  std::optional<UtcTime> last_time_;  // absolute; the next is within twelve hours of it
  std::optional<HeldGst> gst_;
  std::optional<HeldGst> gst_before_;  // a GST may run ahead of the epoch still open
  std::optional<BasePosition> base_;
  std::optional<GroundVelocity> ground_velocity_;
};

}  // namespace plumbline::gnss
