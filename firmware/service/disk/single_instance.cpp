// SPDX-License-Identifier: MIT
#include "firmware/service/disk/single_instance.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace plumbline::service {

Result<SingleInstance> SingleInstance::in(const std::string& folder) {
  const std::string path = folder + "/.lock";
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    return Error{"Cannot open " + path + ": " + std::strerror(errno) +
                 "; give this user the right to write there, or another recording.folder."};
  }
  SingleInstance instance(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return instance;
  return Error{"Another plumblined records into " + folder +
               ": stop it first, or give this one another recording.folder."};
}

SingleInstance::SingleInstance(SingleInstance&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

SingleInstance::~SingleInstance() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace plumbline::service
