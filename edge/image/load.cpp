// SPDX-License-Identifier: MIT
#include "edge/image/load.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <mutex>
#include <optional>
#include <string>

#include "edge/base/parallel.h"

namespace plumbline::image {
namespace {

constexpr int kLevels = 5;

std::optional<Error> load_one(const GreyImageSource& photos, int index, PhotoLevels& levels) {
  const Result<Image> photo = photos(index);
  if (!photo) return photo.error();
  const Image& image = *photo;
  const std::size_t expected =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.channels != 1 || image.data.size() != expected) {
    return Error{"Photo number " + std::to_string(index + 1) +
                 " was handed over with other than one grey byte per pixel; decode it as grey."};
  }
  if (!image.empty()) levels = make_levels(image, kLevels);
  return std::nullopt;
}

}  // namespace

Status load_photos(const GreyImageSource& photos, int photo_count, int threads,
                   const Progress& progress, std::vector<PhotoLevels>& loaded) {
  const int before = static_cast<int>(loaded.size());
  std::vector<PhotoLevels> more(static_cast<std::size_t>(photo_count - before));
  std::vector<std::optional<Error>> errors(more.size());
  std::mutex mutex;
  int done = before;
  parallel_for(photo_count - before, threads, [&](int k) {
    const auto slot = static_cast<std::size_t>(k);
    try {
      errors[slot] = load_one(photos, before + k, more[slot]);
    } catch (const std::exception& error) {
      errors[slot] = Error{"Photo number " + std::to_string(before + k + 1) +
                           " could not be loaded (" + error.what() + "); leave it out."};
    }
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress("load photos", done, photo_count);
  });
  for (const auto& error : errors) {
    if (error) return *error;
  }
  std::move(more.begin(), more.end(), std::back_inserter(loaded));
  return Done{};
}

}  // namespace plumbline::image
