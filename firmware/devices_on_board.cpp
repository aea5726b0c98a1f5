// SPDX-License-Identifier: MIT
#include "firmware/devices_on_board.h"

#include <charconv>
#include <filesystem>
#include <utility>

#include "drivers/camera/camera_module.h"
#include "drivers/camera/v4l2_camera.h"
#include "drivers/gnss/stream_receiver.h"
#include "drivers/gpio/gpio_trigger_line.h"
#include "drivers/mavlink/stream_pilot_link.h"
#include "drivers/posix/file_stream.h"
#include "drivers/posix/posix_storage.h"
#include "drivers/posix/pps_line.h"
#include "drivers/posix/serial_port.h"
#include "drivers/posix/serial_port_list.h"
#include "drivers/posix/system_clock.h"
#include "drivers/posix/tcp_stream.h"
#include "drivers/posix/udp_stream.h"
#include "edge/gnss/stream_decoder.h"
#include "edge/mavlink/conversation.h"

namespace plumbline {
namespace {

using ReceiverResult = Result<std::unique_ptr<GnssReceiver>>;

ReceiverResult receiver_on(std::unique_ptr<ByteStream> stream, const Clock& clock, int baud) {
  return {std::make_unique<gnss_driver::StreamReceiver>(
      std::move(stream), gnss::make_fix_decoder, clock,
      gnss_driver::StreamReceiverOptions{.baud = baud})};
}

struct HostAndPort {
  std::string host;
  std::string port;
};

// Of "tcp://HOST:PORT" and the like.
Result<HostAndPort> host_and_port(const std::string& address) {
  const std::size_t begin = address.find("://") + 3;
  const std::size_t colon = address.rfind(':');
  if (colon <= begin || colon + 1 == address.size()) {
    return Error{"'" + address + "' names no host and port: write " + address.substr(0, begin) +
                 "HOST:PORT."};
  }
  return HostAndPort{address.substr(begin, colon - begin), address.substr(colon + 1)};
}

ReceiverResult receiver_on_host(const std::string& address, const Clock& clock) {
  const Result<HostAndPort> place = host_and_port(address);
  if (!place) return place.error();
  return receiver_on(std::make_unique<posix::TcpStream>(place->host, place->port), clock, 0);
}

// The number after '@'; 0 where there is none, -1 where it is no number.
int baud_of(const std::string& address) {
  const std::size_t at = address.find('@');
  if (at == std::string::npos) return 0;
  int baud = -1;
  const char* end = address.data() + address.size();
  const auto read = std::from_chars(address.data() + at + 1, end, baud);
  return read.ec == std::errc{} && read.ptr == end && baud > 0 ? baud : -1;
}

ReceiverResult receiver_on_port(const std::string& address, const Clock& clock) {
  const int baud = baud_of(address);
  auto port = std::make_unique<posix::SerialPort>(address.substr(0, address.find('@')));
  if (baud < 0) {
    return Error{"'" + address + "' names no speed after '@': write " + port->name() + "@115200."};
  }
  if (baud > 0) {
    if (const Status speed = port->set_speed(baud); !speed) return speed.error();
  }
  return receiver_on(std::move(port), clock, baud);
}

using PilotResult = Result<std::unique_ptr<PilotLink>>;

// How an autopilot's link is made, once its address is understood.
struct PilotMaking {
  int system_id;
  const Clock& clock;

  PilotResult on(std::unique_ptr<DuplexStream> stream,
                 mavlink_driver::StreamPilotLinkOptions options = {}) const {
    const auto make_conversation = [id = system_id](PilotProtocol::Sink sink) {
      return std::make_unique<mavlink::Conversation>(std::move(sink),
                                                     mavlink::ConversationOptions{.system_id = id});
    };
    return {std::make_unique<mavlink_driver::StreamPilotLink>(std::move(stream), make_conversation,
                                                              clock, options)};
  }
};

PilotResult pilot_on_network(const std::string& address, const PilotMaking& making) {
  using Role = posix::UdpStream::Role;
  const Result<HostAndPort> place = host_and_port(address);
  if (!place) return place.error();
  const Role role = place->host == "0.0.0.0" ? Role::kListens : Role::kSpeaks;
  return making.on(std::make_unique<posix::UdpStream>(role, place->host, place->port));
}

PilotResult pilot_on_port(const std::string& address, const PilotMaking& making) {
  const int baud = baud_of(address);
  auto port = std::make_unique<posix::SerialPort>(address.substr(0, address.find('@')));
  if (baud < 0) {
    return Error{"'" + address + "' names no speed after '@': write " + port->name() + "@57600."};
  }
  if (baud == 0) return making.on(std::move(port));
  if (const Status speed = port->set_speed(baud); !speed) return speed.error();
  return making.on(std::move(port), {.baud = baud});
}

constexpr std::string_view kLibcamera = "libcamera:";

// Loaded once; it stays loaded.
const Result<CameraModule>& camera_module() {
  static const Result<CameraModule> module = CameraModule::load(camera_module_folders());
  return module;
}

void add(Result<CameraDescription> description, const std::string& id, CamerasOnBoard& found) {
  if (!description) {
    found.remarks.push_back(description.error().sentence);
    return;
  }
  description->id = id;
  found.cameras.push_back(std::move(description).value());
}

}  // namespace

std::unique_ptr<Clock> make_clock() { return std::make_unique<posix::SystemClock>(); }

ReceiverResult make_receiver(const std::string& address, const Clock& clock) {
  if (address.starts_with("tcp://")) return receiver_on_host(address, clock);
  std::error_code error;
  if (std::filesystem::is_regular_file(address, error)) {
    return receiver_on(std::make_unique<posix::FileStream>(address), clock, 0);
  }
  if (!address.empty()) return receiver_on_port(address, clock);
  return Error{"The receiver has no address: write a port, tcp://HOST:PORT or a log."};
}

Result<std::unique_ptr<Storage>> open_folder(const std::string& folder) {
  return posix::open_storage(folder);
}

Result<std::unique_ptr<Storage>> open_or_make_folder(const std::string& folder) {
  const std::filesystem::path wanted(folder);
  std::filesystem::path above = wanted;
  std::error_code trouble;
  while (!std::filesystem::exists(above, trouble) && above.has_relative_path()) {
    above = above.parent_path();
  }
  if (above == wanted) return open_folder(folder);
  auto storage = open_folder(above.string());
  if (!storage) return storage.error();
  const std::filesystem::path missing = wanted.lexically_relative(above);
  if (const Status made = (*storage)->make_folder(missing.string()); !made) return made.error();
  for (std::filesystem::path made = missing; made.has_relative_path();) {
    made = made.parent_path();
    if (const Status kept = (*storage)->sync_folder(made.string()); !kept) return kept.error();
  }
  return open_folder(folder);
}

std::optional<std::string> folder_warning(const std::string& folder) {
  return posix::file_system_warning(folder);
}

Result<std::unique_ptr<TriggerLine>> make_shutter_wires(const ShutterWires& wires,
                                                        const Clock& clock) {
  gpio::TriggerLineOptions options;
  options.pulse_width = wires.pulse_width;
  if (!wires.pulse_line.empty()) options.out = {wires.pulse_line, wires.pulse_active_low};
  if (!wires.feedback_line.empty()) options.in = {wires.feedback_line, wires.feedback_active_low};
  return gpio::make_trigger_line(options, clock);
}

Result<std::unique_ptr<TriggerLine>> make_pulse_per_second(const std::string& address,
                                                           const Clock& clock) {
  constexpr std::string_view kGpio = "gpio:";
  if (!address.starts_with(kGpio)) return posix::open_pps_line(address, clock);
  gpio::TriggerLineOptions options;
  options.in = {address.substr(kGpio.size()), false};
  return gpio::make_trigger_line(options, clock);
}

PilotResult make_pilot_link(const std::string& address, int system_id, const Clock& clock) {
  const PilotMaking making{system_id, clock};
  if (address.starts_with("udp://")) return pilot_on_network(address, making);
  if (address.starts_with("/")) return pilot_on_port(address, making);
  return Error{"'" + address +
               "' is no address of an autopilot: write a port (/dev/ttyAMA1@57600), "
               "udp://0.0.0.0:14550 or udp://HOST:PORT."};
}

std::vector<SerialPortInfo> list_serial_ports() { return posix::list_serial_ports(); }

Result<std::unique_ptr<Camera>> make_camera(const std::string& id, const Clock& clock) {
  if (!id.starts_with(kLibcamera)) {
    return {std::unique_ptr<Camera>(std::make_unique<V4l2Camera>(id, clock))};
  }
  if (!camera_module()) return camera_module().error();
  return camera_module()->make(id.substr(kLibcamera.size()), clock);
}

CamerasOnBoard list_cameras() {
  CamerasOnBoard found;
  const std::unique_ptr<Clock> clock = make_clock();
  if (camera_module()) {
    for (const std::string& id : camera_module()->list()) {
      add(camera_module()->make(id, *clock)->describe(), std::string(kLibcamera) + id, found);
    }
  } else {
    found.remarks.push_back(camera_module().error().sentence);
  }
  for (const std::string& path : list_v4l2()) add(describe_v4l2(path), path, found);
  return found;
}

}  // namespace plumbline
