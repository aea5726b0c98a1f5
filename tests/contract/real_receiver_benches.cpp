// SPDX-License-Identifier: MIT
#include "tests/contract/real_receiver_benches.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdlib>
#include <filesystem>

#include "drivers/gnss/stream_receiver.h"
#include "drivers/posix/descriptor.h"
#include "drivers/posix/serial_port.h"
#include "drivers/posix/system_clock.h"
#include "drivers/posix/tcp_stream.h"
#include "edge/gnss/stream_decoder.h"
#include "sim/pty_port.h"

namespace plumbline::contract {
namespace {

// The real driver in real time.
class RealBench : public ReceiverBench {
 public:
  GnssReceiver& receiver() override { return *receiver_; }
  ReceiverEvents& events() override { return events_; }
  HostTime now() override { return clock_.now(); }

  void pass(std::chrono::nanoseconds time) override {
    const std::size_t before = events_.count();
    const HostTime end = now() + time;
    while (events_.count() == before && now() < end) {
      clock_.wait(nothing_, std::min(end, now() + std::chrono::milliseconds(5)));
    }
  }

 protected:
  void drive(std::unique_ptr<ByteStream> stream) {
    receiver_ = std::make_unique<gnss_driver::StreamReceiver>(std::move(stream),
                                                              gnss::make_fix_decoder, clock_);
  }

  posix::SystemClock clock_;
  Signal nothing_;
  ReceiverEvents events_;
  std::unique_ptr<GnssReceiver> receiver_;  // last: its thread ends first
};

class PtyBench : public RealBench {
 public:
  PtyBench() : port_(new_folder() + "/ttyRTK") {
    drive(std::make_unique<posix::SerialPort>(port_.path()));
  }
  ~PtyBench() override {
    receiver_.reset();
    port_.pull();
    std::filesystem::remove(std::filesystem::path(port_.path()).parent_path());
  }

  void plug_in() override { ASSERT_TRUE(port_.plug_in()); }
  void pull() override { port_.pull(); }
  void send(std::string_view bytes) override { port_.send(bytes); }

 private:
  static std::string new_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "plumbline-pty-XXXXXX").string();
    return ::mkdtemp(name.data());
  }

  sim::PtyPort port_;
};

class TcpBench : public RealBench {
 public:
  TcpBench() {
    plug_in();  // once, to be given a number that is free
    TcpBench::pull();
    drive(std::make_unique<posix::TcpStream>("127.0.0.1", std::to_string(port_)));
  }

  void plug_in() override {
    listener_ = posix::Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const int yes = 1;
    ::setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port_);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    ASSERT_EQ(::bind(listener_.get(), generic, size), 0);
    ASSERT_EQ(::listen(listener_.get(), 4), 0);
    ASSERT_EQ(::getsockname(listener_.get(), generic, &size), 0);
    port_ = ntohs(address.sin_port);
  }

  void pull() override {
    client_.close();
    listener_.close();
  }

  void send(std::string_view bytes) override {
    if (listener_.is_open()) {
      posix::Descriptor next(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
      if (next.is_open()) client_ = std::move(next);
    }
    if (client_.is_open()) ::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

 private:
  posix::Descriptor listener_;
  posix::Descriptor client_;
  std::uint16_t port_ = 0;
};

std::string setting(const std::string& name) {
  const char* value = std::getenv(("PLUMBLINE_TEST_SERIAL" + name).c_str());
  return value == nullptr ? "" : value;
}

class KernelPortBench : public RealBench {
 public:
  KernelPortBench() {
    run("_PULL");
    drive(std::make_unique<posix::SerialPort>(setting("")));
  }
  ~KernelPortBench() override { receiver_.reset(); }

  void plug_in() override {
    ASSERT_TRUE(run("_PLUG"));
    far_ = posix::Descriptor(::open(setting("_FAR").c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
    ASSERT_TRUE(far_.is_open()) << setting("_FAR");
    termios raw{};
    if (::tcgetattr(far_.get(), &raw) != 0) return;  // not a terminal: as it is
    ::cfmakeraw(&raw);
    ::tcsetattr(far_.get(), TCSANOW, &raw);
  }

  void pull() override {
    ASSERT_TRUE(run("_PULL"));
    far_.close();
  }

  void send(std::string_view bytes) override {
    while (!bytes.empty()) {
      const ssize_t taken = ::write(far_.get(), bytes.data(), bytes.size());
      if (taken <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(taken));
    }
  }

 private:
  static bool run(const std::string& name) { return std::system(setting(name).c_str()) == 0; }

  posix::Descriptor far_;
};

}  // namespace

std::unique_ptr<ReceiverBench> make_pty_bench() { return std::make_unique<PtyBench>(); }
std::unique_ptr<ReceiverBench> make_tcp_bench() { return std::make_unique<TcpBench>(); }
std::unique_ptr<ReceiverBench> make_kernel_port_bench() {
  return std::make_unique<KernelPortBench>();
}

}  // namespace plumbline::contract
