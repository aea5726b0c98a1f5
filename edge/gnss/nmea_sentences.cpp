// SPDX-License-Identifier: MIT
#include "edge/gnss/nmea_sentences.h"

#include <cmath>

#include "edge/base/units.h"
#include "edge/gnss/text_fields.h"

namespace plumbline::gnss {
namespace {

constexpr double kKnot_m_s = 1852.0 / 3600.0;
constexpr double kKmh_m_s = 1.0 / 3.6;

// Reads the fields of one sentence by index and remembers whether any of them was nonsense.
class Reader {
 public:
  Reader(Fields fields, std::size_t at_least) : fields_(fields), ok_(fields.size() >= at_least) {}

  bool ok() const { return ok_; }

  std::string_view text(std::size_t i) const {
    return i < fields_.size() ? fields_[i] : std::string_view{};
  }

  std::optional<double> number(std::size_t i) { return checked(i, decimal(text(i))); }
  std::optional<int> count(std::size_t i) { return checked(i, whole_number(text(i))); }
  std::optional<TimeOfDay> time(std::size_t i) { return checked(i, time_of_day(text(i))); }

  std::optional<double> not_negative(std::size_t i) {
    const auto value = number(i);
    if (value && *value < 0) ok_ = false;
    return value;
  }

  // One of `letters`, or '\0' for an empty field.
  char letter(std::size_t i, std::string_view letters) {
    const std::string_view field = text(i);
    if (field.empty()) return '\0';
    if (field.size() != 1 || letters.find(field[0]) == std::string_view::npos) ok_ = false;
    return field[0];
  }

  // Latitude, its letter, longitude, its letter, from field i on: all four or none.
  std::optional<Place> place(std::size_t i) {
    const char north = letter(i + 1, "NS");
    const char east = letter(i + 3, "EW");
    const auto latitude = checked(i, degrees_and_minutes(text(i), 2, 90.0));
    const auto longitude = checked(i + 2, degrees_and_minutes(text(i + 2), 3, 180.0));
    const int present = (north != 0) + (east != 0) + latitude.has_value() + longitude.has_value();
    if (present != 0 && present != 4) ok_ = false;
    if (!ok_ || present == 0) return std::nullopt;
    return Place{north == 'S' ? -*latitude : *latitude, east == 'W' ? -*longitude : *longitude};
  }

  std::optional<std::chrono::sys_days> date(std::size_t i, std::string_view day,
                                            std::string_view month, std::string_view year,
                                            int century) {
    if (day.empty() && month.empty() && year.empty()) return std::nullopt;
    const auto d = whole_number(day);
    const auto m = whole_number(month);
    const auto y = whole_number(year);
    using namespace std::chrono;
    if (i >= fields_.size() || !d || !m || !y) return fail<sys_days>();
    const year_month_day value{std::chrono::year(*y + century),
                               std::chrono::month(static_cast<unsigned>(*m)),
                               std::chrono::day(static_cast<unsigned>(*d))};
    if (!value.ok()) return fail<sys_days>();
    return sys_days(value);
  }

  template <typename T>
  std::optional<T> fail() {
    ok_ = false;
    return std::nullopt;
  }

 private:
  template <typename T>
  std::optional<T> checked(std::size_t i, std::optional<T> value) {
    if (!value && !text(i).empty()) ok_ = false;
    return value;
  }

  Fields fields_;
  bool ok_;
};

template <typename T>
std::optional<T> if_ok(const Reader& reader, T&& value) {
  if (!reader.ok()) return std::nullopt;
  return std::forward<T>(value);
}

// The digits of GGA; 9 is what NovAtel writes for a position corrected by satellites (SBAS).
std::optional<FixQuality> quality_of_digit(std::string_view field) {
  if (field.empty()) return FixQuality::kNone;
  if (field == "9") return FixQuality::kDifferential;
  if (field.size() != 1 || field[0] < '0' || field[0] > '8') return std::nullopt;
  return static_cast<FixQuality>(field[0] - '0');
}

constexpr std::string_view kModeLetters = "NADPRFEMS";

FixQuality quality_of_mode(char letter) {
  switch (letter) {
    case 'A':
      return FixQuality::kSingle;
    case 'D':
      return FixQuality::kDifferential;
    case 'P':
      return FixQuality::kPps;
    case 'R':
      return FixQuality::kFixed;
    case 'F':
      return FixQuality::kFloat;
    case 'E':
      return FixQuality::kEstimated;
    case 'M':
      return FixQuality::kManual;
    case 'S':
      return FixQuality::kSimulated;
    default:
      return FixQuality::kNone;
  }
}

// GNS has one letter per constellation; the solution is as good as the best of them.
std::optional<FixQuality> quality_of_modes(std::string_view letters) {
  if (letters.find_first_not_of(kModeLetters) != std::string_view::npos) return std::nullopt;
  for (const char best : {'R', 'F', 'P', 'D', 'A', 'E', 'M', 'S'}) {
    if (letters.find(best) != std::string_view::npos) return quality_of_mode(best);
  }
  return FixQuality::kNone;
}

// The east-north covariance from the error ellipse (semi-axes a, b; orientation theta of the major
// one from north): (a^2 - b^2) sin(theta) cos(theta). Taken only where the ellipse agrees with the
// sigmas beside it to a tenth; receivers differ in what they put there.
double covariance_east_north(double a, double b, double theta_deg, double var_e, double var_n) {
  const double s = std::sin(theta_deg * kRadPerDeg);
  const double c = std::cos(theta_deg * kRadPerDeg);
  const double off_e = std::abs(a * a * s * s + b * b * c * c - var_e);
  const double off_n = std::abs(a * a * c * c + b * b * s * s - var_n);
  const double cov = (a * a - b * b) * s * c;
  const bool agrees = off_e + off_n <= 0.1 * (var_e + var_n) && cov * cov < 0.98 * var_e * var_n;
  return agrees ? cov : 0.0;
}

GroundVelocity ground_velocity(double speed_m_s, std::optional<double> course_deg) {
  return {speed_m_s, course_deg};
}

}  // namespace

std::optional<Gga> read_gga(const Fields& fields) {
  Reader in(fields, 14);
  const auto quality = quality_of_digit(in.text(5));
  if (!quality) return std::nullopt;
  in.letter(9, "M");
  in.letter(11, "M");
  in.not_negative(7);
  return if_ok(in, Gga{in.time(0), *quality, in.place(1), in.number(8), in.number(10), in.count(6),
                       in.not_negative(12)});
}

std::optional<Gga> read_gns(const Fields& fields) {
  Reader in(fields, 12);
  const auto quality = quality_of_modes(in.text(5));
  if (!quality) return std::nullopt;
  in.not_negative(7);
  return if_ok(in, Gga{in.time(0), *quality, in.place(1), in.number(8), in.number(9), in.count(6),
                       in.not_negative(10)});
}

std::optional<Gst> read_gst(const Fields& fields) {
  Reader in(fields, 8);
  Gst gst{in.time(0), std::nullopt};
  const auto major = in.not_negative(2);
  const auto minor = in.not_negative(3);
  const auto theta = in.number(4);
  const auto north = in.not_negative(5);
  const auto east = in.not_negative(6);
  const auto up = in.not_negative(7);
  in.not_negative(1);
  if (!in.ok()) return std::nullopt;
  if (!north || !east || !up || *north * *east * *up == 0) return gst;
  Eigen::Matrix3d covariance =
      Eigen::Vector3d(*east * *east, *north * *north, *up * *up).asDiagonal();
  if (major && minor && theta) {
    covariance(0, 1) = covariance(1, 0) =
        covariance_east_north(*major, *minor, *theta, covariance(0, 0), covariance(1, 1));
  }
  gst.covariance_enu_m2 = covariance;
  return gst;
}

std::optional<Rmc> read_rmc(const Fields& fields) {
  Reader in(fields, 11);
  Rmc rmc;
  rmc.time_of_day = in.time(0);
  rmc.valid = in.letter(1, "AV") == 'A';
  rmc.place = in.place(2);
  const auto knots = in.not_negative(6);
  const auto course = in.not_negative(7);
  if (knots) rmc.velocity = ground_velocity(*knots * kKnot_m_s, course);
  const std::string_view date = in.text(8);
  if (!date.empty() && date.size() != 6) return std::nullopt;
  // Two digits of the year: 80 to 99 are the last century's (GPS began in 1980).
  const int century = date.size() == 6 && date[4] >= '8' ? 1900 : 2000;
  if (!date.empty()) {
    rmc.date = in.date(8, date.substr(0, 2), date.substr(2, 2), date.substr(4, 2), century);
  }
  const char mode = in.letter(11, kModeLetters);
  if (rmc.valid) rmc.quality = mode == '\0' ? FixQuality::kSingle : quality_of_mode(mode);
  return if_ok(in, std::move(rmc));
}

std::optional<Zda> read_zda(const Fields& fields) {
  Reader in(fields, 4);
  return if_ok(in, Zda{in.time(0), in.date(3, in.text(1), in.text(2), in.text(3), 0)});
}

std::optional<Vtg> read_vtg(const Fields& fields) {
  Reader in(fields, 8);
  Vtg vtg;
  const auto course = in.not_negative(0);
  in.letter(1, "T");
  in.letter(5, "N");
  in.letter(7, "K");
  const auto knots = in.not_negative(4);
  const auto kmh = in.not_negative(6);
  if (knots) vtg.velocity = ground_velocity(*knots * kKnot_m_s, course);
  if (!knots && kmh) vtg.velocity = ground_velocity(*kmh * kKmh_m_s, course);
  return if_ok(in, std::move(vtg));
}

std::optional<Ebp> read_ebp(const Fields& fields) {
  Reader in(fields, 6);
  in.letter(5, "M");
  const auto place = in.place(0);
  const auto height = in.number(4);
  Ebp ebp;
  if (place) ebp.base = BasePosition{place->latitude_deg, place->longitude_deg, height};
  return if_ok(in, std::move(ebp));
}

}  // namespace plumbline::gnss
