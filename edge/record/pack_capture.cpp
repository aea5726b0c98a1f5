// SPDX-License-Identifier: MIT
#include "edge/record/pack_capture.h"

#include <optional>
#include <utility>
#include <variant>

namespace plumbline::record {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

// One function lists the fields of each struct; a pass over it writes them, or reads them.
struct Write {
  Packer& to;
  template <typename T>
  void operator()(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      to.put(static_cast<std::uint8_t>(value));
    } else {
      to.put(value);
    }
  }
};

struct Read {
  Unpacker& from;
  void operator()(bool& value) { value = from.get<bool>(); }
  void operator()(int& value) { value = from.get<std::int32_t>(); }
  void operator()(std::uint64_t& value) { value = from.get<std::uint64_t>(); }
  void operator()(double& value) { value = from.get<double>(); }
  void operator()(nanoseconds& value) { value = from.get<nanoseconds>(); }
  void operator()(HostTime& value) { value = from.get_time<HostTime>(); }
  void operator()(WallTime& value) { value = from.get_time<WallTime>(); }
  void operator()(FixQuality& value) { value = from.get_case<FixQuality>(9); }
  void operator()(capture::Reason& value) { value = from.get_case<capture::Reason>(6); }
  void operator()(capture::Phase& value) { value = from.get_case<capture::Phase>(4); }
};

// Optional fields: a byte that says whether, then the value.
template <typename T>
void optional_field(Write& pass, const std::optional<T>& value) {
  pass(value.has_value());
  if (value) pass(*value);
}
template <typename T>
void optional_field(Read& pass, std::optional<T>& value) {
  bool has = false;
  pass(has);
  if (has) pass(value.emplace());
}

// UTC in microseconds, which is what receivers' times are kept in.
void utc_field(Write& pass, const std::optional<UtcTime>& time) {
  std::optional<nanoseconds> since;
  if (time) since = nanoseconds(time->time_since_epoch().count());
  optional_field(pass, since);
}
void utc_field(Read& pass, std::optional<UtcTime>& time) {
  std::optional<nanoseconds> since;
  optional_field(pass, since);
  if (since) time = UtcTime(microseconds(since->count()));
}
void day_field(Write& pass, const std::optional<microseconds>& time) {
  std::optional<nanoseconds> since;
  if (time) since = nanoseconds(time->count());
  optional_field(pass, since);
}
void day_field(Read& pass, std::optional<microseconds>& time) {
  std::optional<nanoseconds> since;
  optional_field(pass, since);
  if (since) time = microseconds(since->count());
}

template <typename Pass, typename Matrix>
void matrix_fields(Pass& pass, Matrix& matrix) {
  for (int k = 0; k < matrix.size(); ++k) pass(matrix.data()[k]);
}
void covariance_field(Write& pass, const std::optional<Eigen::Matrix3d>& covariance) {
  pass(covariance.has_value());
  if (covariance) matrix_fields(pass, *covariance);
}
void covariance_field(Read& pass, std::optional<Eigen::Matrix3d>& covariance) {
  bool has = false;
  pass(has);
  if (has) matrix_fields(pass, covariance.emplace());
}

template <typename Pass, typename Fix>
void fix_fields(Pass& pass, Fix& fix) {
  utc_field(pass, fix.time);
  day_field(pass, fix.time_of_day);
  pass(fix.quality);
  optional_field(pass, fix.latitude_deg);
  optional_field(pass, fix.longitude_deg);
  optional_field(pass, fix.height_ellipsoidal_m);
  optional_field(pass, fix.altitude_m);
  covariance_field(pass, fix.covariance_enu_m2);
  optional_field(pass, fix.satellites);
  optional_field(pass, fix.correction_age_s);
}

void flags_field(Write& pass, const std::vector<std::uint8_t>& flags) {
  pass(static_cast<int>(flags.size()));
  for (const std::uint8_t flag : flags) pass(flag != 0);
}
void flags_field(Read& pass, std::vector<std::uint8_t>& flags) {
  constexpr int kMost = 4096;
  int size = 0;
  pass(size);
  for (int k = 0; k < size && k < kMost && pass.from.good(); ++k) {
    bool flag = false;
    pass(flag);
    flags.push_back(flag ? 1 : 0);
  }
}

template <typename Pass, typename Target>
void target_fields(Pass& pass, Target& target) {
  pass(target.reason);
  pass(target.entry);
  pass(target.height_m);
}

template <typename Pass, typename Place>
void place_fields(Pass& pass, Place& place) {
  matrix_fields(pass, place.in_enu_m);
  matrix_fields(pass, place.covariance_m2);
  matrix_fields(pass, place.velocity_m_s);
  pass(place.height_m);
  pass(place.quality);
  pass(place.age);
}
void place_field(Write& pass, const std::optional<capture::Place>& place) {
  pass(place.has_value());
  if (place) place_fields(pass, *place);
}
void place_field(Read& pass, std::optional<capture::Place>& place) {
  bool has = false;
  pass(has);
  if (has) place_fields(pass, place.emplace());
}

template <typename Pass, typename Marks>
void marks_fields(Pass& pass, Marks& marks) {
  pass(marks.late);
  pass(marks.reckoned);
  pass(marks.no_position);
  pass(marks.not_fixed);
  pass(marks.still);
  pass(marks.jumped);
  pass(marks.resumed);
}

// `Like` is the struct, const where it is written.
template <typename T, typename Struct>
concept Like = std::same_as<std::remove_const_t<T>, Struct>;

template <typename Pass, Like<capture::Started> T>
void fields(Pass& pass, T& started) {
  pass(started.wall);
}
template <typename Pass, Like<capture::Resumed> T>
void fields(Pass& pass, T& resumed) {
  pass(resumed.flying);
  pass(resumed.ground_height_m);
  utc_field(pass, resumed.last_fix);
  pass(resumed.photos);
  flags_field(pass, resumed.taken);
  optional_field(pass, resumed.last_seen);
}
template <typename Pass, Like<capture::FixHeard> T>
void fields(Pass& pass, T& heard) {
  fix_fields(pass, heard.fix);
  pass(heard.first_byte);
  pass(heard.jumped);
}
template <typename Pass, Like<capture::PulsePerSecond> T>
void fields(Pass& pass, T& pulse) {
  pass(pulse.edge);
}
template <typename Pass, Like<capture::FrameSeen> T>
void fields(Pass& pass, T& frame) {
  pass(frame.sequence);
  pass(frame.interior_number);
  pass(frame.timing.first_row_start);
  pass(frame.timing.exposure);
  pass(frame.timing.row_time);
  pass(frame.timing.sigma);
  pass(frame.rows);
}
template <typename Pass, Like<capture::CameraSeen> T>
void fields(Pass& pass, T& camera) {
  pass(camera.streaming);
}
template <typename Pass, Like<capture::ShutterOpened> T>
void fields(Pass& pass, T& opened) {
  pass(opened.edge);
}
template <typename Pass, Like<capture::PilotSeen> T>
void fields(Pass& pass, T& pilot) {
  optional_field(pass, pilot.armed);
}
template <typename Pass, Like<capture::Tick> T>
void fields(Pass&, T&) {}
template <typename Pass, Like<capture::PilotHeightSeen> T>
void fields(Pass& pass, T& height) {
  pass(height.above_arming_m);
  pass(height.climb_m_s);
}
template <typename Pass, Like<capture::PhotoLost> T>
void fields(Pass& pass, T& lost) {
  pass(lost.number);
}

template <typename Pass, Like<capture::Pulse> T>
void fields(Pass& pass, T& pulse) {
  pass(pulse.number);
}
template <typename Pass, Like<capture::PhotoTaken> T>
void fields(Pass& pass, T& taken) {
  pass(taken.number);
  target_fields(pass, taken.target);
  optional_field(pass, taken.frame);
  pass(taken.wanted);
  pass(taken.exposed);
  pass(taken.exposed_sigma);
  place_field(pass, taken.place);
  marks_fields(pass, taken.marks);
}
template <typename Pass, Like<capture::PhotoMissed> T>
void fields(Pass& pass, T& missed) {
  pass(missed.number);
  target_fields(pass, missed.target);
  pass(missed.wanted);
}
template <typename Pass, Like<capture::PhaseChanged> T>
void fields(Pass& pass, T& changed) {
  pass(changed.phase);
  optional_field(pass, changed.ground_height_m);
}
template <typename Pass, Like<capture::GroundFound> T>
void fields(Pass& pass, T& ground) {
  pass(ground.ground_height_m);
}
template <typename Pass, Like<capture::HeightPassed> T>
void fields(Pass& pass, T& passed) {
  target_fields(pass, passed.target);
}

// The variant's case number `index`, read.
template <typename Variant, std::size_t k = 0>
Variant read_case(std::size_t index, Unpacker& from) {
  if constexpr (k + 1 < std::variant_size_v<Variant>) {
    if (index != k) return read_case<Variant, k + 1>(index, from);
  }
  std::variant_alternative_t<k, Variant> what;
  Read pass{from};
  fields(pass, what);
  return what;
}

}  // namespace

bool is_input(std::uint16_t kind) {
  return kind >= kFirstInput && kind < kFirstInput + std::variant_size_v<capture::Happening>;
}

bool is_decision(std::uint16_t kind) {
  return kind >= kFirstDecision && kind < kFirstDecision + std::variant_size_v<capture::Decided>;
}

std::uint16_t kind_of_input(const capture::Input& input) {
  return static_cast<std::uint16_t>(kFirstInput + input.what.index());
}

std::uint16_t kind_of_decision(const capture::Decision& decision) {
  return static_cast<std::uint16_t>(kFirstDecision + decision.what.index());
}

void pack_input(Packer& to, const capture::Input& input) {
  to.put(input.now);
  Write pass{to};
  std::visit([&](const auto& what) { fields(pass, what); }, input.what);
}

void pack_decision(Packer& to, const capture::Decision& decision) {
  to.put(decision.time);
  Write pass{to};
  std::visit([&](const auto& what) { fields(pass, what); }, decision.what);
}

capture::Input unpack_input(std::uint16_t kind, Unpacker& from) {
  const auto now = from.get_time<HostTime>();
  return {now, read_case<capture::Happening>(std::size_t{kind} - kFirstInput, from)};
}

capture::Decision unpack_decision(std::uint16_t kind, Unpacker& from) {
  const auto time = from.get_time<HostTime>();
  return {time, read_case<capture::Decided>(std::size_t{kind} - kFirstDecision, from)};
}

}  // namespace plumbline::record
