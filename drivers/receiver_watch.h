// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "drivers/gnss_receiver.h"
#include "drivers/receiver_judge.h"
#include "edge/base/fix_decoder.h"

namespace plumbline {

// What every GnssReceiver makes of the bytes that arrive, be they real, simulated or recorded: the
// bytes themselves, fixes with the arrival of their first and last byte, and reports of its state.
// Knows no clock and no thread: every call brings the time, which never goes back. All members but
// counters() are called from one thread.
class ReceiverWatch {
 public:
  ReceiverWatch(const MakeFixDecoder& make_decoder, GnssReceiver::Sink sink);
  ReceiverWatch(const ReceiverWatch&) = delete;  // its decoder calls back into it
  ReceiverWatch& operator=(const ReceiverWatch&) = delete;

  // For the sentences: "/dev/ttyACM0 at 115200 baud".
  void set_name(std::string name) { judge_.set_name(std::move(name)); }

  void opened(HostTime now);
  // The stream broke off, or is not there. `again`: reported also where it was absent already, if
  // the sentence is another.
  void absent(HostTime now, const std::string& sentence, bool again = false);
  // What comes from here on does not go on with what came before (another speed).
  void cut(HostTime now);
  void bytes(HostTime arrival, std::string_view bytes);

  // When nothing has come until due(): hands out the epoch of a burst that is over, and reports
  // silence and the like. due() is HostTime::max() for never.
  void look(HostTime now);
  HostTime due(HostTime now) const;

  ReceiverCounters counters() const;  // from any thread

 private:
  struct Piece {
    std::uint64_t end = 0;  // offset in all bytes
    HostTime arrival;
  };

  void hand_on(const GnssFix& fix, ByteRange bytes);
  HostTime arrival_of(std::uint64_t byte) const;
  void count();

  GnssReceiver::Sink sink_;
  ReceiverJudge judge_;
  std::unique_ptr<FixDecoder> decoder_;
  std::deque<Piece> pieces_;  // those that the next epoch may be of
  std::uint64_t bytes_ = 0;
  std::uint64_t sentences_ = 0;
  bool burst_ = false;  // bytes have come since the last epoch was flushed
  HostTime now_;        // of the call that is being served
  bool was_open_ = false;

  mutable std::mutex mutex_;
  ReceiverCounters counters_;  // under the mutex
};

}  // namespace plumbline
