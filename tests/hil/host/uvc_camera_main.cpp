// SPDX-License-Identifier: MIT
// A USB camera behind QEMU's usb-redir device that looks down on the simulated ground and climbs at
// 2 m/s, from where the drone is when a frame is exposed.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <thread>

#include "sim/flight.h"
#include "tests/hil/host/uvc_camera.h"

namespace plumbline::hil {
namespace {

using std::chrono::steady_clock;

struct Settings {
  std::string socket;
  std::string orders;
  UvcMode mode;
  std::uint64_t delay_ms = 0;
};

// Black and white of full range: red, green and blue to Y, grey for U and V.
std::string yuy2_of(const Image& image) {
  std::string bytes;
  bytes.reserve(2 * image.data.size() / 3);
  for (std::size_t i = 0; i + 2 < image.data.size(); i += 3) {
    const int luma = 299 * image.data[i] + 587 * image.data[i + 1] + 114 * image.data[i + 2];
    bytes += static_cast<char>(luma / 1000);
    bytes += static_cast<char>(128);
  }
  return bytes;
}

class SimulatedView {
 public:
  explicit SimulatedView(const UvcMode& mode)
      : profile_(profile_of(mode)),
        flight_(sim::fly(profile_, 1)),
        world_(sim::world_for(profile_, 1, 2), std::nullopt) {}

  std::string expose(std::uint64_t frame) const {
    geometry::Pose pose = flight_.shots.front().pose;
    pose.centre_m.z() +=
        std::min(profile_.climb_rate_m_s * seconds(), profile_.to_m - profile_.from_m);
    return yuy2_of(
        sim::render(world_, flight_.camera, pose, sim::sensor_for(flight_, 0), frame, 1));
  }

 private:
  static sim::Profile profile_of(const UvcMode& mode) {
    sim::Profile profile = *sim::named_profile("paper");
    profile.focal_length_px *= mode.width_px / static_cast<double>(profile.width_px);
    profile.width_px = mode.width_px;
    profile.height_px = mode.height_px;
    return profile;
  }
  double seconds() const {
    return std::chrono::duration<double>(steady_clock::now() - begin_).count();
  }

  sim::Profile profile_;
  sim::Flight flight_;
  sim::World world_;
  steady_clock::time_point begin_ = steady_clock::now();
};

// "plug", "unplug", "silence", "speak", a line each.
void obey(const std::string& line, UvcOrders& orders) {
  if (line == "plug" || line == "unplug") orders.plugged = line == "plug";
  if (line == "silence" || line == "speak") orders.silent = line == "silence";
}

// Until the other side closes the socket.
void take_orders(const posix::Descriptor& socket, UvcOrders& orders) {
  std::string line;
  for (char letter = 0; ::read(socket.get(), &letter, 1) == 1;) {
    if (letter != '\n') {
      line += letter;
      continue;
    }
    obey(line, orders);
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
  const auto expose = [&view](std::uint64_t frame, const UvcSettings& /*set*/) {
    return view.expose(frame);
  };
  UvcCamera(link, settings.mode, expose, orders, std::chrono::milliseconds(settings.delay_ms))
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
  app.add_option("--orders", settings.orders, "socket that says: plug, unplug, silence, speak");
  app.add_option("--delay-ms", settings.delay_ms, "from exposure to the first byte");
  CLI11_PARSE(app, count, arguments);
  return plumbline::hil::run(settings);
}
