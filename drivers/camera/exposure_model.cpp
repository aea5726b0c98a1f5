// SPDX-License-Identifier: MIT
#include "drivers/camera/exposure_model.h"

#include <cmath>

namespace plumbline {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr double kInterruptJitterS = 1e-4;  // between the event and its stamp, seen on USB and CSI

struct Uncertain {
  double mean_s = 0;
  double variance_s2 = 0;
};

Uncertain uniform(double low_s, double high_s) {
  const double width_s = high_s - low_s;
  return {0.5 * (low_s + high_s), width_s * width_s / 12.0};
}

Uncertain known(const ExposureHistory::Exposure& exposure) {
  const double sigma_s = Seconds(exposure.sigma).count();
  return {Seconds(exposure.mean).count(), sigma_s * sigma_s};
}

Uncertain operator+(Uncertain a, Uncertain b) {
  return {a.mean_s + b.mean_s, a.variance_s2 + b.variance_s2};
}

std::chrono::nanoseconds ns(double seconds) {
  return std::chrono::nanoseconds(std::llround(seconds * 1e9));
}

// From the stamp to the middle row's end of exposure, where readout took `readout_s`.
Uncertain with_readout(const ExposureModel& model, double readout_s) {
  const double period_s = Seconds(model.period).count();
  const double exposure_s = model.exposure ? Seconds(model.exposure->mean).count() : 0;
  switch (model.meaning) {
    case StampMeaning::kStartOfExposure:
      return {exposure_s + 0.5 * readout_s, 0};
    case StampMeaning::kStartOfReadout:
      return {0.5 * readout_s, 0};
    case StampMeaning::kEndOfFrame:
      return {-0.5 * readout_s, 0};
    case StampMeaning::kFirstPacket:
      return uniform(-period_s + 0.5 * readout_s, 0.5 * readout_s);
    case StampMeaning::kArrival:
      return uniform(-period_s - 0.5 * readout_s, -0.5 * readout_s);
  }
  return {};
}

// The same where readout is anything from 0 to a period, of a rolling or a global shutter.
Uncertain without_readout(const ExposureModel& model) {
  const double period_s = Seconds(model.period).count();
  const Uncertain stamped = with_readout(model, 0);
  const bool at_end =
      model.meaning == StampMeaning::kEndOfFrame || model.meaning == StampMeaning::kArrival;
  return stamped + (at_end ? uniform(-period_s, 0) : uniform(0, 0.5 * period_s));
}

Uncertain to_end_of_exposure(const ExposureModel& model) {
  if (!model.row_time) return without_readout(model);
  return with_readout(model, Seconds(*model.row_time).count() * (model.rows - 1));
}

}  // namespace

ExposureTiming exposure_of(HostTime stamp, const ExposureModel& model) {
  const double period_s = Seconds(model.period).count();
  const Uncertain end = to_end_of_exposure(model);
  const Uncertain exposure = model.exposure ? known(*model.exposure) : uniform(0, period_s);
  // From its end to its middle; of an exposure that is stamped at its start, from start to middle.
  const bool from_start = model.meaning == StampMeaning::kStartOfExposure && !model.exposure;
  const double half = from_start ? 0.5 : -0.5;
  const double middle_s = end.mean_s + half * exposure.mean_s;
  const double variance_s2 =
      end.variance_s2 + 0.25 * exposure.variance_s2 + kInterruptJitterS * kInterruptJitterS;
  ExposureTiming timing;
  timing.exposure = ns(exposure.mean_s);
  timing.row_time = model.row_time.value_or(std::chrono::nanoseconds(0));
  timing.sigma = ns(std::sqrt(variance_s2));
  const double to_first_row_s = 0.5 * (model.rows - 1) * Seconds(timing.row_time).count();
  timing.first_row_start = stamp + ns(middle_s - 0.5 * exposure.mean_s - to_first_row_s);
  return timing;
}

}  // namespace plumbline
