// SPDX-License-Identifier: MIT
#include "sim/camera_link.h"

#include <utility>

namespace plumbline::sim {
namespace {

struct Lent {
  FramePixels picture;
  RawImage image;
  std::shared_ptr<int> count;

  Lent(FramePixels pixels, std::shared_ptr<int> lent)
      : picture(std::move(pixels)), count(std::move(lent)) {
    image.format = picture.format;
    image.width_px = picture.width_px;
    image.height_px = picture.height_px;
    image.stride_bytes = row_bytes(picture.format, picture.width_px);
    image.second_plane_offset = picture.format == PixelFormat::kNv12
                                    ? image.stride_bytes * static_cast<std::size_t>(image.height_px)
                                    : 0;
    image.bytes = picture.bytes;
    ++*count;
  }
  ~Lent() { --*count; }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;
};

}  // namespace

void CameraLink::deliver(HostTime now, Frame frame, FramePixels picture) {
  if (!has_free_buffer()) {
    lose();
    return;
  }
  report(now, CameraState::kStreaming, "The camera delivers frames.");
  const std::uint64_t lost = std::exchange(pending_lost_, 0);
  if (lost > 0) sink_(FramesLost{now, lost});
  next_ += lost;
  frame.sequence = next_++;
  const auto lent = std::make_shared<Lent>(std::move(picture), lent_);
  frame.image = {lent, &lent->image};
  sink_(std::move(frame));
}

void CameraLink::report(HostTime now, CameraState state, const std::string& sentence) {
  if (reported_ == state) return;
  reported_ = state;
  sink_(CameraReport{now, state, sentence});
}

std::optional<Error> other_mode_than(const CameraOptions& options, PixelFormat format, int width_px,
                                     int height_px) {
  const int width = options.width_px.value_or(width_px);
  const int height = options.height_px.value_or(height_px);
  const PixelFormat wanted = options.format.value_or(format);
  if (width == width_px && height == height_px && wanted == format) return std::nullopt;
  const auto text = [](int w, int h, PixelFormat f) {
    return std::to_string(w) + " x " + std::to_string(h) + " " + name_of(f);
  };
  return Error{"The camera has no mode " + text(width, height, wanted) + "; it has " +
               text(width_px, height_px, format) + "."};
}

}  // namespace plumbline::sim
