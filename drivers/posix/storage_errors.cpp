// SPDX-License-Identifier: MIT
#include "drivers/posix/storage_errors.h"

#include <array>
#include <cerrno>
#include <system_error>

namespace plumbline::posix {
namespace {

struct Explanation {
  int code;
  const char* text;
};

constexpr std::array<Explanation, 13> kExplanations = {{
    {ENOSPC, "the disk is full; make space on it"},
    {EDQUOT, "the user's share of the disk is used up; make space, or have it raised"},
    {EROFS, "the file system is read-only; mount it for writing, and check the disk"},
    {EIO, "the disk failed (input/output error); replace it, and copy what it still holds"},
    {EFBIG, "the file would become larger than is allowed; raise the limit on file sizes"},
    {EACCES, "no right to; check the owner and mode of the folder"},
    {EPERM, "it is not permitted; check the owner and flags of the folder"},
    {ENOENT, "there is no such file or folder"},
    {EEXIST, "it is there already"},
    {EISDIR, "it is a folder"},
    {ENOTDIR, "a file is where a folder should be; remove it or choose another name"},
    {ENODEV, "the disk is gone; put it back"},
    {ENXIO, "the disk is gone; put it back"},
}};

std::string why(int code) {
  for (const Explanation& explanation : kExplanations) {
    if (explanation.code == code) return explanation.text;
  }
  return std::generic_category().message(code);
}

}  // namespace

Error storage_error(const std::string& attempted, const std::string& path, int code) {
  return {"Cannot " + attempted + " '" + path + "': " + why(code) + "."};
}

// MSDOS_SUPER_MAGIC and EXFAT_SUPER_MAGIC of linux/magic.h, which has the second since 5.7.
std::optional<std::string> file_system_warning(const std::string& folder, long type) {
  constexpr long kFat = 0x4d44;
  constexpr long kExFat = 0x2011BAB0;
  if (type != kFat && type != kExFat) return std::nullopt;
  return "'" + folder +
         "' lies on a FAT file system, which a power cut can corrupt as a whole: format the card "
         "with ext4.";
}

}  // namespace plumbline::posix
