// SPDX-License-Identifier: MIT
#include "edge/gnss/nmea_parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "edge/gnss/text_fields.h"

namespace plumbline::gnss {
namespace {

constexpr std::chrono::microseconds kDay = std::chrono::hours(24);

bool is_read(std::string_view type) {
  constexpr std::array<std::string_view, 7> kTypes = {"GGA", "RMC", "GST", "VTG",
                                                      "GNS", "ZDA", "EBP"};
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

bool is_standard_talker(std::string_view address) {
  return address.size() == 5 && address[0] != 'P';
}

// Both were written as decimals of at most six places: so is their sum.
double exact_sum(double a, double b) { return std::round((a + b) * 1e6) / 1e6; }

void put_place(const std::optional<Place>& place, GnssFix& fix) {
  if (!place || fix.quality == FixQuality::kNone) return;
  fix.latitude_deg = place->latitude_deg;
  fix.longitude_deg = place->longitude_deg;
}

void put_gga(const Gga& gga, GnssFix& fix) {
  fix.quality = gga.quality;
  fix.satellites = gga.satellites;
  fix.correction_age_s = gga.correction_age_s;
  put_place(gga.place, fix);
  if (!fix.latitude_deg) return;
  fix.altitude_m = gga.altitude_m;
  if (gga.altitude_m && gga.separation_m) {
    fix.height_ellipsoidal_m = exact_sum(*gga.altitude_m, *gga.separation_m);
  }
}

}  // namespace

NmeaParser::NmeaParser(Sink sink, NmeaOptions options)
    : sink_(std::move(sink)),
      options_(options),
      framer_([this](std::string_view body) { return take(body); }) {}

void NmeaParser::flush() {
  if (epoch_ && (epoch_->gga || epoch_->gns)) flushed_ = epoch_->time_of_day;
  close();
}

void NmeaParser::finish() {
  framer_.finish();
  close();
}

bool NmeaParser::take(std::string_view body) {
  const std::size_t comma = std::min(body.find(','), body.size());
  const std::string_view address = body.substr(0, comma);
  if (!is_standard_talker(address)) return true;
  const std::string_view type = address.substr(2);
  if (!is_read(type)) return true;
  const Fields fields = split_fields(body.substr(std::min(comma + 1, body.size())));
  if (type == "GST") return take_gst(fields);
  if (type == "ZDA") return take_zda(fields);
  if (type == "VTG") return take_vtg(fields);
  if (type == "EBP") return take_ebp(fields);
  return take_place(type, fields);
}

// A sentence has at most 255 characters, and so no more fields than there is room for.
Fields NmeaParser::split_fields(std::string_view text) {
  std::size_t count = 0;
  while (true) {
    const std::size_t comma = text.find(',');
    fields_[count++] = text.substr(0, comma);
    if (comma == std::string_view::npos) return {fields_.data(), count};
    text.remove_prefix(comma + 1);
  }
}

bool NmeaParser::take_place(std::string_view type, const Fields& fields) {
  if (type == "GGA") return join(read_gga(fields), &Epoch::gga);
  if (type == "GNS") return join(read_gns(fields), &Epoch::gns);
  if (type != "RMC") return true;
  const auto rmc = read_rmc(fields);
  if (!join(rmc, &Epoch::rmc)) return false;
  if (rmc->valid) learn_date(rmc->time_of_day, rmc->date);
  if (rmc->velocity) ground_velocity_ = rmc->velocity;
  return true;
}

bool NmeaParser::take_gst(const Fields& fields) {
  const auto gst = read_gst(fields);
  if (!gst) return false;
  note_time(gst->time_of_day);
  if (!gst->time_of_day || !gst->covariance_enu_m2) return true;
  gst_before_ =
      std::exchange(gst_, HeldGst{*gst->time_of_day, *gst->covariance_enu_m2, std::nullopt});
  return true;
}

bool NmeaParser::take_zda(const Fields& fields) {
  const auto zda = read_zda(fields);
  if (!zda) return false;
  note_time(zda->time_of_day);
  learn_date(zda->time_of_day, zda->date);
  return true;
}

bool NmeaParser::take_vtg(const Fields& fields) {
  const auto vtg = read_vtg(fields);
  if (!vtg) return false;
  if (vtg->velocity) ground_velocity_ = vtg->velocity;
  return true;
}

bool NmeaParser::take_ebp(const Fields& fields) {
  const auto ebp = read_ebp(fields);
  if (!ebp) return false;
  if (ebp->base) base_ = ebp->base;
  return true;
}

// A sentence without a position is of the epoch of its time, or goes before it.
void NmeaParser::note_time(const std::optional<TimeOfDay>& time) {
  if (!time) return;
  if (epoch_ && epoch_->time_of_day == time) {
    epoch_->bytes.end = framer_.sentence_bytes().end;
  } else if (!herald_ || herald_->time_of_day != *time) {
    herald_ = Herald{*time, framer_.sentence_bytes().begin};
  }
}

std::uint64_t NmeaParser::first_byte_of(const std::optional<TimeOfDay>& time) const {
  const bool heralded = herald_ && time && herald_->time_of_day == *time;
  return heralded ? herald_->begin : framer_.sentence_bytes().begin;
}

// Its epoch was handed out before the burst had ended.
bool NmeaParser::is_late(const std::optional<TimeOfDay>& time) const {
  return !epoch_ && time && flushed_ == time;
}

// A sentence of another time begins another epoch; without a time, so does one heard already.
template <typename Sentence>
bool NmeaParser::join(std::optional<Sentence> sentence, std::optional<Sentence> Epoch::*slot) {
  if (!sentence) return false;
  if (is_late(sentence->time_of_day)) return true;
  const bool other_time = epoch_ && epoch_->time_of_day != sentence->time_of_day;
  const bool again = epoch_ && !sentence->time_of_day && ((*epoch_).*slot).has_value();
  if (other_time || again) close();
  if (!epoch_) {
    epoch_ = Epoch{sentence->time_of_day, {}, {}, {}, {first_byte_of(sentence->time_of_day), 0}};
    flushed_ = std::nullopt;
  }
  epoch_->bytes.end = framer_.sentence_bytes().end;
  (*epoch_).*slot = std::move(sentence);
  return true;
}

void NmeaParser::learn_date(const std::optional<TimeOfDay>& time,
                            std::optional<std::chrono::sys_days> date) {
  if (time && date) last_time_ = *date + *time;
}

void NmeaParser::close() {
  if (!epoch_) return;
  const Epoch epoch = *std::exchange(epoch_, std::nullopt);
  const bool has_gga_or_gns = epoch.gga || epoch.gns;
  if (!has_gga_or_gns && gga_or_gns_heard_) return;
  gga_or_gns_heard_ = gga_or_gns_heard_ || has_gga_or_gns;
  GnssFix fix = fix_of(epoch);
  fix.time = resolve(fix.time_of_day);
  fix.covariance_enu_m2 = covariance_for(fix);
  epoch_bytes_ = epoch.bytes;
  ++framer_.counters().epochs;
  sink_(fix);
}

GnssFix NmeaParser::fix_of(const Epoch& epoch) const {
  GnssFix fix;
  fix.time_of_day = epoch.time_of_day;
  if (epoch.gga || epoch.gns) {
    put_gga(epoch.gga ? *epoch.gga : *epoch.gns, fix);
  } else {
    fix.quality = epoch.rmc->quality;
    put_place(epoch.rmc->place, fix);
  }
  return fix;
}

// The day that puts the time of day nearest to the last known time.
std::optional<UtcTime> NmeaParser::resolve(const std::optional<TimeOfDay>& time) {
  if (!time || !last_time_) return std::nullopt;
  UtcTime resolved = std::chrono::floor<std::chrono::days>(*last_time_) + *time;
  if (resolved - *last_time_ > kDay / 2) resolved -= kDay;
  if (*last_time_ - resolved > kDay / 2) resolved += kDay;
  last_time_ = resolved;
  return resolved;
}

std::optional<Eigen::Matrix3d> NmeaParser::covariance_for(const GnssFix& fix) {
  if (!fix.time_of_day) return std::nullopt;
  for (std::optional<HeldGst>* held : {&gst_, &gst_before_}) {
    if (!held->has_value()) continue;
    HeldGst& gst = **held;
    const TimeOfDay age = (*fix.time_of_day - gst.time_of_day + kDay) % kDay;
    if (age == TimeOfDay::zero()) gst.quality = fix.quality;
    if (age > options_.gst_hold) continue;
    const bool same_kind = !gst.quality || *gst.quality == fix.quality;
    if (!same_kind || !fix.latitude_deg) return std::nullopt;
    return gst.covariance_enu_m2;
  }
  return std::nullopt;
}

}  // namespace plumbline::gnss
