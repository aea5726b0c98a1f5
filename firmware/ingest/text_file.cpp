// SPDX-License-Identifier: MIT
#include "firmware/ingest/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace plumbline::ingest {
namespace {

Error cannot_read(const std::filesystem::path& path, const std::string& why) {
  return {"Cannot read " + in_quotes(path.string()) + ": " + why + "."};
}

template <typename Bytes>
Result<Bytes> read_all(const std::filesystem::path& path, std::size_t max_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return cannot_read(path, "it is a folder, a file is wanted");
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) return cannot_read(path, errno != 0 ? std::strerror(errno) : "it cannot be opened");
  Bytes bytes;
  std::vector<char> chunk(1u << 16);
  while (in.read(chunk.data(), static_cast<std::streamsize>(chunk.size())), in.gcount() > 0) {
    bytes.insert(bytes.end(), chunk.data(), chunk.data() + in.gcount());
    if (bytes.size() > max_bytes) {
      return cannot_read(path, "it is larger than the " + std::to_string(max_bytes >> 20) +
                                   " MB accepted for such a file");
    }
  }
  if (in.bad()) return cannot_read(path, "reading failed midway");
  return bytes;
}

}  // namespace

Result<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes) {
  return read_all<std::string>(path, max_bytes);
}

Result<std::vector<std::uint8_t>> read_bytes(const std::filesystem::path& path,
                                             std::size_t max_bytes) {
  return read_all<std::vector<std::uint8_t>>(path, max_bytes);
}

std::string in_quotes(std::string_view text) {
  std::string result = "'";
  return result.append(text).append("'");
}

std::string at_line(const std::string& name, std::size_t line) {
  return name + ":" + std::to_string(line) + ": ";
}

}  // namespace plumbline::ingest
