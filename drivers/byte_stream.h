// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "edge/base/result.h"

namespace plumbline {

// A serial port that the system knows, and what its USB device says of itself.
struct SerialPortInfo {
  std::string path;  // "/dev/ttyACM0"
  std::string vid;   // four hexadecimal digits; empty where it hangs on no USB
  std::string pid;
  std::string serial;        // empty where the device has none
  std::string manufacturer;  // empty where not said
  std::string product;       // empty where not said
};

// A place that bytes come from, and that may go away and return: a serial port, a host, a file.
// All members are called from one thread, interrupt() and name() from any. No member throws; a
// failure is an outcome with a sentence. The destructor closes.
class ByteStream {
 public:
  enum class Presence {
    kOpen,
    kAbsent,  // not there, or not yet: try again
    kRefused  // there, but waiting cannot help: no right, held by another, not what it should be
  };
  struct Opening {
    Presence presence = Presence::kOpen;
    std::string sentence;  // unless open
  };

  enum class Arrival {
    kBytes,
    kNothing,  // until the time was over, or interrupted
    kGone,     // unplugged, closed by the other side, failing: closed; open() again
    kEnd       // of a file: closed, and there is no more
  };
  struct Reading {
    Arrival arrival = Arrival::kNothing;
    std::string_view bytes;  // of kBytes; valid until the next call
    std::string sentence;    // of kGone and kEnd
  };

  virtual ~ByteStream() = default;

  // At once, or (a host) within two seconds. May be called when open: closes first.
  virtual Opening open() = 0;

  // Waits for the next bytes, `at_most` so long.
  virtual Reading read(std::chrono::nanoseconds at_most) = 0;

  virtual void close() = 0;

  // Waits, to try again later; interrupt() ends it.
  virtual void pause(std::chrono::nanoseconds time) = 0;

  // Ends the wait of read(), pause() or open() that is going on, or else the next one.
  virtual void interrupt() = 0;

  // The speeds in baud worth trying, the most usual first; empty where it has no speed to set.
  virtual std::vector<int> speeds() const { return {}; }

  // Of what is open and of what will be opened. Fails where the port cannot.
  virtual Status set_speed(int /*baud*/) { return Done{}; }

  virtual std::string name() const = 0;  // "/dev/ttyACM0"
};

// A place that takes bytes too.
class DuplexStream : public ByteStream {
 public:
  // At once: returns how many of the first bytes were taken, 0 where the line is full or nobody is
  // there to send to. A stream that has gone takes nothing, and the next read() says so. Of a
  // stream of datagrams the bytes are one, taken whole or not at all.
  virtual std::size_t write(std::string_view bytes) = 0;
};

}  // namespace plumbline
