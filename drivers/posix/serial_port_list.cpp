// SPDX-License-Identifier: MIT
#include "drivers/posix/serial_port_list.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

namespace plumbline::posix {
namespace {

namespace fs = std::filesystem;

std::string first_line_of(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

// The USB device above a port's own folder of /sys/devices, if it hangs on one.
std::optional<fs::path> usb_device_above(fs::path folder) {
  std::error_code error;
  for (; folder.has_relative_path(); folder = folder.parent_path()) {
    if (fs::exists(folder / "idVendor", error)) return folder;
  }
  return std::nullopt;
}

// The kernel lists four UARTs of PCs, there or not; those that are not have the type 0.
bool is_there(const fs::path& port) {
  std::error_code error;
  return fs::exists(port / "device", error) && first_line_of(port / "type") != "0";
}

SerialPortInfo describe(const fs::path& port) {
  SerialPortInfo info;
  info.path = "/dev/" + port.filename().string();
  std::error_code error;
  const fs::path device = fs::canonical(port / "device", error);
  const auto usb = usb_device_above(device);
  if (!usb) return info;
  info.vid = first_line_of(*usb / "idVendor");
  info.pid = first_line_of(*usb / "idProduct");
  info.serial = first_line_of(*usb / "serial");
  info.manufacturer = first_line_of(*usb / "manufacturer");
  info.product = first_line_of(*usb / "product");
  return info;
}

}  // namespace

std::vector<SerialPortInfo> list_serial_ports(const fs::path& sys) {
  std::vector<SerialPortInfo> ports;
  std::error_code error;
  for (fs::directory_iterator at(sys / "class" / "tty", error), end; !error && at != end;
       at.increment(error)) {
    if (is_there(at->path())) ports.push_back(describe(at->path()));
  }
  std::sort(ports.begin(), ports.end(),
            [](const SerialPortInfo& a, const SerialPortInfo& b) { return a.path < b.path; });
  return ports;
}

}  // namespace plumbline::posix
