// SPDX-License-Identifier: MIT
#include "tests/contract/kernel_receiver_bench.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "drivers/gnss/stream_receiver.h"
#include "drivers/posix/descriptor.h"
#include "drivers/posix/serial_port.h"
#include "drivers/posix/system_clock.h"
#include "edge/gnss/stream_decoder.h"

namespace plumbline::contract {
namespace {

using namespace std::chrono_literals;

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

class KernelReceiverBench : public ReceiverBench {
 public:
  KernelReceiverBench()
      : port_(setting("PLUMBLINE_TEST_SERIAL")),
        far_(::open(setting("PLUMBLINE_TEST_SERIAL_FAR").c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC)),
        receiver_(std::make_unique<posix::SerialPort>(port_), gnss::make_fix_decoder, clock_) {}
  ~KernelReceiverBench() override {
    receiver_.stop();
    KernelReceiverBench::pull();
  }

  GnssReceiver& receiver() override { return receiver_; }
  ReceiverEvents& events() override { return events_; }
  HostTime now() override { return clock_.now(); }

  void plug_in() override { run("PLUMBLINE_TEST_SERIAL_PLUG", true); }
  void pull() override {
    if (std::filesystem::exists(port_)) run("PLUMBLINE_TEST_SERIAL_PULL", false);
  }

  void send(std::string_view bytes) override {
    while (!bytes.empty()) {
      const ssize_t count = ::write(far_.get(), bytes.data(), bytes.size());
      ASSERT_GT(count, 0) << setting("PLUMBLINE_TEST_SERIAL_FAR");
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  void pass(std::chrono::nanoseconds time) override {
    const std::size_t before = events_.count();
    const HostTime end = now() + time;
    while (events_.count() == before && now() < end)
      clock_.wait(nothing_, std::min(end, now() + 5ms));
  }

 private:
  // Returns when the port's node is there, or gone: the promises count from then.
  void run(const char* command, bool there) {
    ASSERT_EQ(std::system(setting(command).c_str()), 0) << command;
    const HostTime latest = now() + 20s;
    while (std::filesystem::exists(port_) != there && now() < latest)
      std::this_thread::sleep_for(5ms);
    ASSERT_EQ(std::filesystem::exists(port_), there) << port_;
  }

  std::string port_;
  posix::Descriptor far_;
  posix::SystemClock clock_;
  Signal nothing_;
  ReceiverEvents events_;
  gnss_driver::StreamReceiver receiver_;
};

}  // namespace

std::unique_ptr<ReceiverBench> make_kernel_receiver_bench() {
  if (setting("PLUMBLINE_TEST_SERIAL").empty()) return nullptr;
  return std::make_unique<KernelReceiverBench>();
}

}  // namespace plumbline::contract
