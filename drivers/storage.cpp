// SPDX-License-Identifier: MIT
#include "drivers/storage.h"

namespace plumbline {
namespace {

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

Status write_synced(Storage& storage, const std::string& path, std::string_view bytes) {
  auto file = storage.create(path);
  if (!file) return file.error();
  if (const Status appended = (*file)->append(bytes); !appended) return appended;
  return (*file)->sync();
}

}  // namespace

Status publish(Storage& storage, const std::string& path, std::string_view bytes) {
  const std::string part = path + ".part";
  const Status gone = storage.remove(part);  // of an earlier attempt; mostly there is none
  if (const Status written = write_synced(storage, part, bytes); !written) {
    const Status cleaned = storage.remove(part);
    return written;
  }
  if (const Status renamed = storage.rename(part, path); !renamed) return renamed;
  return storage.sync_folder(folder_of(path));
}

}  // namespace plumbline
