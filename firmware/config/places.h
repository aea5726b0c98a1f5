// SPDX-License-Identifier: MIT
#pragma once

#include <string>

// Where things are, as text in the configuration: whether it can be such a place at all. Whether
// something is there is for whoever opens it.

namespace plumbline::config {

// Of at most 200 bytes, without control characters; may be empty.
bool is_text(const std::string& text);

bool is_absolute_path(const std::string& text);
bool is_absolute_path_or_empty(const std::string& text);

// Fits a sockaddr_un: 107 bytes.
bool is_socket_path(const std::string& text);

// "/dev/ttyACM0", "/dev/ttyAMA0@38400", "tcp://HOST:PORT", or the path of a log.
bool is_receiver_address(const std::string& text);

// "/dev/gpiochip0:17", "gpiochip0:17" or a line's own name; may be empty.
bool is_gpio_line_or_empty(const std::string& text);

// "gpio:LINE", "/dev/pps0" or empty.
bool is_pps_or_empty(const std::string& text);

// "udp://HOST:PORT", a serial port with or without speed, or empty.
bool is_pilot_link_or_empty(const std::string& text);

}  // namespace plumbline::config
