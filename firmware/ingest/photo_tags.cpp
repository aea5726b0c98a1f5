// SPDX-License-Identifier: MIT
#include "firmware/ingest/photo_tags.h"

#include <exception>
#include <exiv2/exiv2.hpp>
#include <mutex>

#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

// Maker notes alone can hold megabytes.
constexpr std::size_t kMaxValueBytes = 4096;

template <typename Data>
void collect(const Data& data, const char* family, Tags& tags) {
  for (const auto& datum : data) {
    const std::string key = datum.key();
    if (!key.starts_with(family) || static_cast<std::size_t>(datum.size()) > kMaxValueBytes)
      continue;
    tags.emplace(key, datum.toString());
  }
}

// Exiv2 is told to be silent, since it would write to stderr; its XMP parser keeps global state and
// is not reentrant, hence the lock.
std::mutex& exiv2_lock() {
  static std::mutex lock;
  return lock;
}

}  // namespace

Tags read_tags(std::span<const std::uint8_t> jpeg, const std::string& name,
               std::vector<std::string>& warnings) {
  const std::lock_guard<std::mutex> guard(exiv2_lock());
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
  Tags tags;
  try {
    // The type of the size differs between 0.27 (long) and 0.28 (size_t).
    const auto image = Exiv2::ImageFactory::open(jpeg.data(), static_cast<long>(jpeg.size()));
    image->readMetadata();
    collect(image->exifData(), "Exif.Image.", tags);
    collect(image->exifData(), "Exif.Photo.", tags);
    collect(image->exifData(), "Exif.GPSInfo.", tags);
    collect(image->xmpData(), "Xmp.", tags);
  } catch (const std::exception& error) {
    warnings.push_back("The tags of photo " + in_quotes(name) + " are damaged and were not used (" +
                       error.what() + ").");
    tags.clear();
  }
  return tags;
}

}  // namespace plumbline::ingest
