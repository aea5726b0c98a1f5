// SPDX-License-Identifier: MIT
// bench_lines PORT PPS_PULL FLASH_PULL SHUTTER_VALUE: in the guest, between the lines of a gpio-sim
// chip and the host. A line "pps" or "flash" from the port PORT is a pulse on that input; where the
// shutter's output becomes active, "shutter" is said.
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <thread>

namespace {

constexpr std::chrono::milliseconds kPulse(5);
constexpr std::chrono::milliseconds kLook(2);  // at the shutter, whose pulse lasts 20 ms

int opened(const char* path, int flags) {
  const int file = ::open(path, flags | O_CLOEXEC);
  if (file < 0) std::perror(path);
  return file;
}

void put(int file, std::string_view word) {
  if (::pwrite(file, word.data(), word.size(), 0) < 0) std::perror("bench_lines: a line");
}

void pulse(int line) {
  put(line, "pull-up");
  std::this_thread::sleep_for(kPulse);
  put(line, "pull-down");
}

// Says so until the end; nobody listens where the port's far end is not connected.
void watch(int shutter, int port) {
  bool was_active = false;
  for (;; std::this_thread::sleep_for(kLook)) {
    char value = '0';
    if (::pread(shutter, &value, 1, 0) != 1) continue;
    const bool is_active = value == '1';
    if (is_active && !was_active && ::write(port, "shutter\n", 8) != 8) std::perror("shutter");
    was_active = is_active;
  }
}

}  // namespace

int main(int count, char** names) {
  if (count != 5) {
    std::fprintf(stderr, "Usage: bench_lines PORT PPS_PULL FLASH_PULL SHUTTER_VALUE\n");
    return 2;
  }
  const int port = opened(names[1], O_RDWR | O_NONBLOCK);
  const int pps = opened(names[2], O_WRONLY);
  const int flash = opened(names[3], O_WRONLY);
  const int shutter = opened(names[4], O_RDONLY);
  if (port < 0 || pps < 0 || flash < 0 || shutter < 0) return 1;
  std::thread(watch, shutter, port).detach();
  std::string words;
  for (;;) {
    pollfd ready{port, POLLIN, 0};
    ::poll(&ready, 1, -1);
    std::array<char, 256> bytes{};
    const ssize_t size = ::read(port, bytes.data(), bytes.size());
    if (size <= 0) {  // nobody at the far end
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      continue;
    }
    words.append(bytes.data(), static_cast<std::size_t>(size));
    for (std::size_t end = 0; (end = words.find('\n')) != std::string::npos;
         words.erase(0, end + 1)) {
      const std::string_view word(words.data(), end);
      if (word == "pps") pulse(pps);
      if (word == "flash") pulse(flash);
    }
  }
}
