// SPDX-License-Identifier: MIT
#include "drivers/posix/serial_port.h"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace plumbline::posix {
namespace {

struct Speed {
  int baud;
  speed_t code;
};

// The first are what receivers are usually set to, the most usual first.
constexpr std::array kSpeeds = {
    Speed{115200, B115200}, Speed{38400, B38400},   Speed{9600, B9600},
    Speed{57600, B57600},   Speed{230400, B230400}, Speed{460800, B460800},
    Speed{921600, B921600}, Speed{19200, B19200},   Speed{4800, B4800}};

const Speed* find_speed(int baud) {
  const auto found = std::find_if(kSpeeds.begin(), kSpeeds.end(),
                                  [baud](const Speed& speed) { return speed.baud == baud; });
  return found == kSpeeds.end() ? nullptr : &*found;
}

// An FTDI adapter keeps bytes back for 16 ms unless asked not to. Ports that know nothing of it
// are as fast as they are.
void ask_for_low_latency(int fd) {
  serial_struct settings{};
  if (::ioctl(fd, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= ASYNC_LOW_LATENCY;
  ::ioctl(fd, TIOCSSERIAL, &settings);
}

bool is_absence(int fault) {
  return fault == ENOENT || fault == ENODEV || fault == ENXIO || fault == EIO || fault == ENOTDIR;
}

std::string refusal_of(int fault) {
  switch (fault) {
    case EACCES:
    case EPERM:
      return "may not be opened by this user: add the user to the group dialout and log in again.";
    case EBUSY:
    case EWOULDBLOCK:
      return "is held open by another program: end that one first.";
    case ENOTTY:
    case EISDIR:
    case EINVAL:
      return "is not a serial port: name one of those that `plumbline gnss` lists.";
    default:
      return std::string("cannot be opened as a serial port: ") + std::strerror(fault) +
             "; unplug it and plug it in again.";
  }
}

}  // namespace

ByteStream::Opening SerialPort::open() {
  close();
  // Without blocking, else a UART would wait for its carrier; never our controlling terminal.
  descriptor_ = Descriptor(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  int fault = descriptor_.is_open() ? 0 : errno;
  if (fault == 0) fault = make_ours();
  if (fault == 0) fault = make_raw();
  if (fault == 0) return {Presence::kOpen, {}};
  close();
  return not_open(fault);
}

ByteStream::Opening SerialPort::not_open(int fault) const {
  if (is_absence(fault)) {
    return {Presence::kAbsent, "There is no port " + path_ +
                                   ": plug its device in, or check the cable and its power; it is "
                                   "taken up as soon as it is there."};
  }
  return {Presence::kRefused, path_ + " " + refusal_of(fault)};
}

// Root is not stopped by TIOCEXCL; flock stops every program that asks.
int SerialPort::make_ours() {
  const int fd = descriptor_.get();
  termios any{};
  if (::tcgetattr(fd, &any) != 0) return errno;
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0) return errno;
  return ::ioctl(fd, TIOCEXCL) == 0 ? 0 : errno;
}

int SerialPort::make_raw() {
  const int fd = descriptor_.get();
  const Speed* speed = find_speed(baud_);
  if (speed == nullptr) return EINVAL;
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) return errno;
  ::cfmakeraw(&settings);
  settings.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  // One byte at least: a read of none then means that the port has gone, not that it is silent.
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  ::cfsetispeed(&settings, speed->code);
  ::cfsetospeed(&settings, speed->code);
  if (::tcsetattr(fd, TCSANOW, &settings) != 0) return errno;
  ask_for_low_latency(fd);
  ::tcflush(fd, TCIFLUSH);  // what came at another speed
  return 0;
}

std::vector<int> SerialPort::speeds() const {
  std::vector<int> speeds;
  for (const Speed& speed : kSpeeds) speeds.push_back(speed.baud);
  return speeds;
}

Status SerialPort::set_speed(int baud) {
  if (find_speed(baud) == nullptr) {
    return Error{
        path_ + " cannot be set to " + std::to_string(baud) +
        " baud: choose 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800 or 921600."};
  }
  baud_ = baud;
  if (!descriptor_.is_open()) return Done{};
  const int fault = make_raw();
  if (fault == 0) return Done{};
  return Error{path_ + " does not take " + std::to_string(baud) + " baud: " + std::strerror(fault) +
               "."};
}

std::string SerialPort::why_gone(int fault) const {
  if (fault == 0 || is_absence(fault) || fault == EBADF) {
    return "has gone: plug its device in again, or check the cable and its power; it is taken up "
           "as "
           "soon as it is back.";
  }
  return std::string("fails: ") + std::strerror(fault) + "; it is opened again.";
}

}  // namespace plumbline::posix
