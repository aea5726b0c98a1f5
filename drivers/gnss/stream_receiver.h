// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "drivers/byte_stream.h"
#include "drivers/clock.h"
#include "drivers/gnss/speed_search.h"
#include "drivers/gnss_receiver.h"
#include "drivers/receiver_watch.h"

namespace plumbline::gnss_driver {

struct StreamReceiverOptions {
  int baud = 0;  // of a serial port; 0: found by trying the usual ones
};

// A receiver at the other end of a stream of bytes. Owns one thread, from start() to stop() or the
// end of a file. A stream that goes away is looked for ten times a second.
class StreamReceiver : public GnssReceiver {
 public:
  // `clock` outlives it.
  StreamReceiver(std::unique_ptr<ByteStream> stream, MakeFixDecoder make_decoder,
                 const Clock& clock, StreamReceiverOptions options = {});
  ~StreamReceiver() override;

  Status start(Sink sink) override;
  void stop() override;
  std::string name() const override;
  ReceiverCounters counters() const override;

 private:
  Status set_first_speed();
  void run();
  void look_for_stream();
  void read_on();
  void take(const ByteStream::Reading& reading, HostTime now);
  void take_bytes(std::string_view bytes, HostTime now);
  void change_speed_if_wrong(HostTime now);

  std::unique_ptr<ByteStream> stream_;
  MakeFixDecoder make_decoder_;
  const Clock& clock_;
  StreamReceiverOptions options_;
  std::atomic<int> baud_ = 0;  // 0: none
  std::atomic<bool> stopping_ = false;
  bool open_ = false;
  bool ended_ = false;
  std::optional<SpeedSearch> search_;
  std::unique_ptr<ReceiverWatch> watch_;
  mutable std::mutex watch_mutex_;  // guards the pointer between start() and counters()
  std::thread thread_;
};

}  // namespace plumbline::gnss_driver
