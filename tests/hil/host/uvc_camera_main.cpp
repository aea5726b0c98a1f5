// SPDX-License-Identifier: MIT
// A USB camera behind QEMU's usb-redir device that looks down on the simulated ground, from where
// the drone is when a frame is exposed.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/hil/host/simulated_view.h"

namespace plumbline::hil {
namespace {

struct Settings {
  std::string socket;
  std::string orders;
  UvcMode mode;
};

// "plug", "unplug", "silence", "speak", "delay MS" (UvcOrders), "time": a line each. The time is
// answered, in nanoseconds of this machine's monotonic clock: by it the guest tells what of the
// exposure marks its own clock says.
void obey(const std::string& line, const posix::Descriptor& socket, UvcOrders& orders) {
  if (line == "plug" || line == "unplug") orders.plugged = line == "plug";
  if (line == "silence" || line == "speak") orders.silent = line == "silence";
  if (line.starts_with("delay ")) orders.longest_delay_ms = std::atoi(line.c_str() + 6);
  if (line != "time") return;
  const std::chrono::nanoseconds now = std::chrono::steady_clock::now().time_since_epoch();
  const std::string answer = std::to_string(now.count()) + "\n";
  [[maybe_unused]] const ssize_t sent = ::write(socket.get(), answer.data(), answer.size());
}

// Until the other side closes the socket.
void take_orders(const posix::Descriptor& socket, UvcOrders& orders) {
  std::string line;
  for (char letter = 0; ::read(socket.get(), &letter, 1) == 1;) {
    if (letter != '\n') {
      line += letter;
      continue;
    }
    obey(line, socket, orders);
    line.clear();
  }
}

int run(const Settings& settings) {
  const SimulatedView view(settings.mode);
  RedirLink link;
  if (!link.open(settings.socket)) {
    std::fprintf(stderr, "uvc_camera: cannot reach QEMU at %s\n", settings.socket.c_str());
    return 1;
  }
  UvcOrders orders;
  const posix::Descriptor orders_socket = connect_to(settings.orders);
  std::thread listener([&] { take_orders(orders_socket, orders); });
  UvcCamera(
      link, settings.mode, [&view](const UvcExposure& exposure) { return view.expose(exposure); },
      orders)
      .run();
  listener.join();  // QEMU, which has both sockets, is gone
  return 0;
}

}  // namespace
}  // namespace plumbline::hil

int main(int count, char** arguments) {
  plumbline::hil::Settings settings;
  CLI::App app{"A USB camera for a virtual machine, over the simulated ground"};
  app.add_option("socket", settings.socket, "of QEMU's usb-redir device")->required();
  app.add_option("--width", settings.mode.width_px, "pixels");
  app.add_option("--height", settings.mode.height_px, "pixels");
  app.add_option("--rate", settings.mode.frames_per_s, "frames per second");
  app.add_option("--orders", settings.orders,
                 "socket that says: plug, unplug, silence, speak, delay MS, time");
  CLI11_PARSE(app, count, arguments);
  return plumbline::hil::run(settings);
}
