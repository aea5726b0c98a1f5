// SPDX-License-Identifier: MIT
#include "firmware/commands/journal_text.h"

#include <array>
#include <cstdio>
#include <sstream>

#include "edge/record/sha256.h"

namespace plumbline::commands {
namespace {

double seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

class Line {
 public:
  Line(HostTime time, const char* kind) {
    char start[64];
    std::snprintf(start, sizeof start, "%14.6f %-10s", seconds(time.time_since_epoch()), kind);
    text_ << start;
  }
  Line& with(const char* name, const std::string& value) {
    text_ << ' ' << name << '=' << value;
    return *this;
  }
  Line& with(const char* name, double value, const char* format = "%.4f") {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return with(name, std::string(text));
  }
  Line& with(const char* name, const std::optional<double>& value, const char* format = "%.4f") {
    return value ? with(name, *value, format) : *this;
  }
  Line& with(const char* name, HostTime time) {
    return with(name, seconds(time.time_since_epoch()), "%.6f");
  }
  Line& count(const char* name, long long value) { return with(name, std::to_string(value)); }
  Line& flag(const char* name, bool value) {
    if (value) text_ << ' ' << name;
    return *this;
  }
  std::string done() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

std::string printable(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    if (c >= ' ' && c <= '~' && c != '\\') {
      text += c;
    } else {
      char hex[8];
      std::snprintf(hex, sizeof hex, "\\x%02x", static_cast<unsigned>(c) & 0xFFu);
      text += hex;
    }
  }
  return text;
}

std::string quoted(const std::string& text) { return '"' + printable(text) + '"'; }

void add(Line& line, const capture::Target& target) {
  line.with("for", name_of(target.reason));
  if (target.reason == capture::Reason::kHeight) line.with("step_m", target.height_m, "%.2f");
}

struct InputText {
  HostTime now;
  std::string operator()(const capture::Started&) const { return Line(now, "started").done(); }
  std::string operator()(const capture::Resumed& r) const {
    return Line(now, "resumed")
        .with("ground_m", r.ground_height_m)
        .count("photos", r.photos)
        .flag("flying", r.flying)
        .done();
  }
  std::string operator()(const capture::FixHeard& heard) const {
    const GnssFix& fix = heard.fix;
    Line line(now, "fix");
    line.count("quality", static_cast<int>(fix.quality))
        .with("lat_deg", fix.latitude_deg, "%.9f")
        .with("lon_deg", fix.longitude_deg, "%.9f")
        .with("height_ellipsoidal_m", fix.height_ellipsoidal_m)
        .with("first_byte", heard.first_byte)
        .flag("jumped", heard.jumped);
    return line.done();
  }
  std::string operator()(const capture::PulsePerSecond& pulse) const {
    return Line(now, "pps").with("edge", pulse.edge).done();
  }
  std::string operator()(const capture::FrameSeen& frame) const {
    return Line(now, "frame")
        .count("sequence", static_cast<long long>(frame.sequence))
        .count("interior", frame.interior_number)
        .with("first_row", frame.timing.first_row_start)
        .with("exposure_s", seconds(frame.timing.exposure), "%.6f")
        .with("sigma_s", seconds(frame.timing.sigma), "%.6f")
        .done();
  }
  std::string operator()(const capture::CameraSeen& camera) const {
    return Line(now, "camera").with("is", camera.streaming ? "streaming" : "away").done();
  }
  std::string operator()(const capture::ShutterOpened& opened) const {
    return Line(now, "shutter").with("edge", opened.edge).done();
  }
  std::string operator()(const capture::PilotSeen& pilot) const {
    Line line(now, "pilot");
    if (!pilot.armed) line.with("is", std::string("unheard"));
    return line.flag("armed", pilot.armed.value_or(false)).done();
  }
  std::string operator()(const capture::Tick&) const { return Line(now, "tick").done(); }
  std::string operator()(const capture::PilotHeightSeen& height) const {
    return Line(now, "pilot_height")
        .with("above_arming_m", height.above_arming_m, "%.3f")
        .with("climb_m_s", height.climb_m_s, "%.2f")
        .done();
  }
  std::string operator()(const capture::PhotoLost& lost) const {
    return Line(now, "lost").count("photo", lost.number).done();
  }
};

void add(Line& line, const capture::Place& place) {
  line.with("height_m", place.height_m, "%.3f")
      .with("sigma_height_m", std::sqrt(place.covariance_m2(2, 2)), "%.3f")
      .with("speed_m_s", place.velocity_m_s.norm(), "%.2f")
      .count("quality", static_cast<int>(place.quality))
      .with("age_s", seconds(place.age), "%.3f");
}

struct DecisionText {
  HostTime time;
  std::string operator()(const capture::Pulse& pulse) const {
    return Line(time, "pulse").count("photo", pulse.number).done();
  }
  std::string operator()(const capture::PhotoTaken& taken) const {
    Line line(time, "taken");
    line.count("photo", taken.number);
    add(line, taken.target);
    line.with("wanted", taken.wanted).with("exposed", taken.exposed);
    if (taken.place) add(line, *taken.place);
    const capture::Marks& marks = taken.marks;
    line.flag("late", marks.late)
        .flag("reckoned", marks.reckoned)
        .flag("no_position", marks.no_position)
        .flag("not_fixed", marks.not_fixed)
        .flag("still", marks.still)
        .flag("jumped", marks.jumped)
        .flag("resumed", marks.resumed);
    return line.done();
  }
  std::string operator()(const capture::PhotoMissed& missed) const {
    Line line(time, "missed");
    line.count("photo", missed.number);
    add(line, missed.target);
    return line.with("wanted", missed.wanted).done();
  }
  std::string operator()(const capture::PhaseChanged& changed) const {
    return Line(time, "phase")
        .with("is", name_of(changed.phase))
        .with("ground_m", changed.ground_height_m)
        .done();
  }
  std::string operator()(const capture::GroundFound& ground) const {
    return Line(time, "ground").with("ground_m", ground.ground_height_m, "%.3f").done();
  }
  std::string operator()(const capture::HeightPassed& passed) const {
    Line line(time, "passed");
    add(line, passed.target);
    return line.done();
  }
};

struct EntryText {
  std::string operator()(const record::Began& began) const {
    return Line(began.host, "began")
        .with("program", quoted(began.program))
        .with("boot", began.boot)
        .with("wall_s", seconds(began.wall.time_since_epoch()), "%.6f")
        .with("configuration", quoted(began.configuration))
        .done();
  }
  std::string operator()(const record::Bytes& bytes) const {
    return Line(bytes.arrival, "bytes").with("are", quoted(bytes.bytes)).done();
  }
  std::string operator()(const record::Stored& stored) const {
    return Line(stored.time, "stored")
        .count("photo", stored.number)
        .with("name", stored.name)
        .count("bytes", static_cast<long long>(stored.length))
        .with("sha256", record::in_hex(stored.sha256))
        .done();
  }
  std::string operator()(const record::Message& message) const {
    static constexpr std::array<const char*, 3> kNames = {"info", "warning", "fault"};
    return Line(message.time, kNames[static_cast<std::size_t>(message.severity)])
        .with("from", quoted(message.source))
        .with("says", quoted(message.sentence))
        .done();
  }
  std::string operator()(const PilotAttitude& attitude) const {
    return Line(attitude.arrival, "attitude")
        .with("roll_rad", attitude.roll_rad)
        .with("pitch_rad", attitude.pitch_rad)
        .with("yaw_rad", attitude.yaw_rad)
        .done();
  }
  std::string operator()(const PilotPosition& position) const {
    return Line(position.arrival, "vehicle")
        .with("lat_deg", position.latitude_deg, "%.7f")
        .with("lon_deg", position.longitude_deg, "%.7f")
        .with("relative_m", position.relative_altitude_m, "%.3f")
        .with("heading_deg", position.heading_deg, "%.2f")
        .done();
  }
  std::string operator()(const record::Ended& ended) const {
    return Line(ended.time, "ended").with("why", quoted(ended.why)).done();
  }
  std::string operator()(const capture::Input& input) const {
    return std::visit(InputText{input.now}, input.what);
  }
  std::string operator()(const capture::Decision& decision) const {
    return std::visit(DecisionText{decision.time}, decision.what);
  }
};

}  // namespace

std::string name_of(capture::Reason reason) {
  static constexpr std::array<const char*, 6> kNames = {"test", "height",   "aside",
                                                        "time", "distance", "blind"};
  return kNames[static_cast<std::size_t>(reason)];
}

std::string name_of(capture::Phase phase) {
  static constexpr std::array<const char*, 4> kNames = {"waiting", "ready", "flying", "landed"};
  return kNames[static_cast<std::size_t>(phase)];
}

std::string text_of(const record::Entry& entry) { return std::visit(EntryText{}, entry); }

}  // namespace plumbline::commands
