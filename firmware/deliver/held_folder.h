// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace plumbline::deliver {

// A folder for a while, known by how its name begins. Its process holds it by a lock that ends with
// the process, however that ends; what nobody holds is left over from one that was killed.
class HeldFolder {
 public:
  HeldFolder() = default;
  ~HeldFolder();  // removes it, with all that is in it
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;

  // Makes it in `parent`, which is cleared before of left-over ones that begin alike and were not
  // changed within the last minute. 0, or why not (errno).
  int make_in(const std::filesystem::path& parent, const std::string& beginning);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace plumbline::deliver
