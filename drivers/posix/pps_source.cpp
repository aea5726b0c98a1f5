// SPDX-License-Identifier: MIT
#include "drivers/posix/pps_source.h"

#include <fcntl.h>
#include <linux/pps.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "drivers/posix/descriptor.h"

namespace plumbline::posix {
namespace {

std::string why_no_pulse(int code) {
  switch (code) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return "it is not there; load the driver of the pulse (pps-gpio, pps-ldisc) or connect it";
    case EACCES:
    case EPERM:
      return "no right to; a udev rule for the subsystem pps gives it to the user's group";
    case ENOTTY:
    case EINVAL:
      return "it is not a PPS device; name one such as /dev/pps0";
    default:
      return std::generic_category().message(code);
  }
}

Error pps_error(const std::string& attempted, const std::string& path, int code) {
  return {"Cannot " + attempted + " '" + path + "': " + why_no_pulse(code) + "."};
}

WallTime wall_time(const pps_ktime& time) {
  return WallTime(std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nsec));
}

class KernelPps : public PpsSource {
 public:
  KernelPps(Descriptor device, std::string path)
      : device_(std::move(device)), path_(std::move(path)) {}

  // The kernel hands out no count when the time is over, and waits only for pulses after the call:
  // one that came before it would be missed if the count were not asked for in any case.
  Result<PpsCount> wait(std::chrono::nanoseconds at_most) override {
    if (at_most.count() > 0) {
      pps_fdata waited{};
      waited.timeout.sec = at_most.count() / 1'000'000'000;
      waited.timeout.nsec = static_cast<__s32>(at_most.count() % 1'000'000'000);
      const int code = fetch(waited);
      if (code != 0 && code != ETIMEDOUT && code != EINTR) return failed(code);
    }
    return count();
  }

 private:
  // A fetch with no time to wait returns at once. A device that was taken away goes on counting
  // nothing while it is open; its name goes.
  Result<PpsCount> count() {
    pps_fdata now{};
    if (const int code = fetch(now)) return failed(code);
    if (::access(path_.c_str(), F_OK) != 0) return failed(ENODEV);
    return PpsCount{now.info.assert_sequence, wall_time(now.info.assert_tu)};
  }
  int fetch(pps_fdata& data) const {
    return ::ioctl(device_.get(), PPS_FETCH, &data) == 0 ? 0 : errno;
  }
  Error failed(int code) const { return pps_error("take pulses from", path_, code); }

  Descriptor device_;
  std::string path_;
};

}  // namespace

Result<std::unique_ptr<PpsSource>> open_pps_source(const std::string& path) {
  Descriptor device(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!device.is_open()) return pps_error("open", path, errno);
  std::unique_ptr<PpsSource> source = std::make_unique<KernelPps>(std::move(device), path);
  if (const auto count = source->wait({}); !count) return count.error();
  return source;
}

}  // namespace plumbline::posix
