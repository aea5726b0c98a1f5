// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "edge/base/pilot_messages.h"
#include "edge/base/result.h"
#include "edge/base/time.h"
#include "edge/capture/decisions.h"
#include "edge/capture/inputs.h"
#include "edge/record/sha256.h"

namespace plumbline::record {

// What a flight's journal holds, in the order in which it happened. record_format.md says how each
// is written.

// The first entry, and again each time the program goes on after it was stopped.
struct Began {
  std::string program;        // name and version
  std::string configuration;  // the file's text, whole
  std::string boot;           // host times of two entries compare only within one boot
  HostTime host;
  WallTime wall;
};

// What the receiver sent, nothing left out.
struct Bytes {
  HostTime arrival;
  std::string bytes;
};

// A photo is on the disk, whole, and stays there.
struct Stored {
  HostTime time;
  int number = 0;
  std::string name;  // "photos/0001.jpg"
  std::uint64_t length = 0;
  Sha256 sha256{};
};

enum class Severity { kInfo, kWarning, kFault };

struct Message {
  HostTime time;
  Severity severity = Severity::kInfo;
  std::string source;  // "camera", "receiver", "disk"
  std::string sentence;
};

// The flight is over and everything is on the disk. Nothing follows, unless the program began anew.
struct Ended {
  HostTime time;
  std::string why;
};

using Entry = std::variant<Began, Bytes, capture::Input, capture::Decision, Stored, Message,
                           PilotAttitude, PilotPosition, Ended>;

// The number that stands for the kind of `entry` on the disk.
std::uint16_t kind_of(const Entry& entry);

// Appends the entry's own bytes, without frame.
void pack(const Entry& entry, std::string& out);

// Fails on a kind that this program does not know, and on bytes that are not such an entry.
Result<Entry> unpack(std::uint16_t kind, std::string_view bytes);

}  // namespace plumbline::record
