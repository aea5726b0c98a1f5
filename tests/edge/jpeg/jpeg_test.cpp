// SPDX-License-Identifier: MIT
#include "edge/jpeg/jpeg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace plumbline::jpeg {
namespace {

using Bytes = std::vector<std::uint8_t>;
using ::testing::HasSubstr;

Image smooth_picture(int width, int height, int channels) {
  Image image{width, height, channels, {}};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      for (int c = 0; c < channels; ++c) {
        image.data.push_back(static_cast<std::uint8_t>(128 + 90 * std::sin(0.05 * u + c) *
                                                                 std::cos(0.04 * v - 0.5 * c)));
      }
    }
  }
  return image;
}

// The entropy-coded part of a noisy picture has no long runs, as that of a photo.
Image noisy_picture(int width, int height) {
  Image image = smooth_picture(width, height, 3);
  std::mt19937 random(7);
  for (std::uint8_t& value : image.data) {
    value = static_cast<std::uint8_t>(value / 2 + random() % 100);
  }
  return image;
}

double rms_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) sum += std::pow(a.data[i] - b.data[i], 2);
  return std::sqrt(sum / static_cast<double>(a.data.size()));
}

TEST(Jpeg, ReadsBackWhatItWroteToTheRoundingOfTheCoding) {
  for (const int channels : {1, 3}) {
    const Image image = smooth_picture(203, 117, channels);
    const Bytes bytes = encode(image, 98);
    const auto back = channels == 1 ? decode_grey(bytes, "a.jpg") : decode_rgb(bytes, "a.jpg");
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->width_px, 203);
    EXPECT_EQ(back->height_px, 117);
    EXPECT_EQ(back->channels, channels);
    EXPECT_LT(rms_difference(*back, image), 2.5);
  }
}

TEST(Jpeg, TellsTheSizeFromTheHeaderAlone) {
  Bytes bytes = encode(noisy_picture(320, 200), 90);
  bytes.resize(700);
  const auto header = read_header(bytes, "a.jpg");
  ASSERT_TRUE(header.ok()) << header.error().sentence;
  EXPECT_EQ(header->width_px, 320);
  EXPECT_EQ(header->height_px, 200);
  EXPECT_EQ(header->channels, 3);
}

// Rec. 601: Y = 0.299 R + 0.587 G + 0.114 B.
TEST(Jpeg, GreyOfAColourPhotoIsItsLuminance) {
  Image red{64, 64, 3, {}};
  for (int i = 0; i < 64 * 64; ++i) red.data.insert(red.data.end(), {200, 40, 10});
  const auto grey = decode_grey(encode(red, 95), "a.jpg");
  ASSERT_TRUE(grey.ok());
  EXPECT_NEAR(grey->data[grey->index(30, 30)], 0.299 * 200 + 0.587 * 40 + 0.114 * 10, 1.5);
}

TEST(Jpeg, RefusesAPhotoCutAnywhereAndNamesIt) {
  const Bytes whole = encode(noisy_picture(320, 240), 90);
  for (std::size_t cut = 1; cut < whole.size(); cut += cut < 700 ? 1 : 997) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut));
    const auto image = decode_grey(part, "IMG_7.jpg");
    ASSERT_FALSE(image.ok()) << "cut at " << cut << " of " << whole.size();
    EXPECT_THAT(image.error().sentence, HasSubstr("'IMG_7.jpg'"));
  }
  // Only the end marker is missing: the file was still being written.
  EXPECT_FALSE(decode_grey(Bytes(whole.begin(), whole.end() - 2), "a.jpg").ok());
  EXPECT_FALSE(decode_grey(Bytes(whole.begin(), whole.end() - 1), "a.jpg").ok());
}

TEST(Jpeg, RefusesAPhotoWhoseTailWasNeverWritten) {
  Bytes bytes = encode(noisy_picture(320, 240), 90);
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2), bytes.end(),
            std::uint8_t{0});
  EXPECT_FALSE(decode_grey(bytes, "a.jpg").ok());
}

TEST(Jpeg, RefusesAPhotoWithAHoleInIt) {
  const Bytes whole = encode(noisy_picture(640, 480), 90);
  Bytes bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 3));
  bytes.insert(bytes.end(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2),
               whole.end());
  EXPECT_FALSE(decode_grey(bytes, "a.jpg").ok());
}

TEST(Jpeg, ToleratesWhatCamerasAppendAfterTheEnd) {
  const Image image = smooth_picture(100, 80, 3);
  Bytes bytes = encode(image, 90);
  const auto without = decode_rgb(bytes, "a.jpg");
  bytes.insert(bytes.end(), 5000, 0xA7);
  const auto with = decode_rgb(bytes, "a.jpg");
  ASSERT_TRUE(with.ok()) << with.error().sentence;
  EXPECT_EQ(with->data, without->data);
}

TEST(Jpeg, ToleratesPaddingBeforeTheEndMarkerAndStrayBytesBetweenSegments) {
  const Bytes whole = encode(smooth_picture(100, 80, 3), 90);
  Bytes padded = whole;
  padded.insert(padded.end() - 2, {0, 0, 0});
  EXPECT_TRUE(decode_rgb(padded, "a.jpg").ok());
  // Behind SOI (2 bytes) and the JFIF segment (18 bytes).
  Bytes stray = whole;
  stray.insert(stray.begin() + 20, {1, 2});
  EXPECT_TRUE(decode_rgb(stray, "a.jpg").ok());
}

TEST(Jpeg, SaysThatATextFileIsNoPhoto) {
  const std::string text = "This is my shopping list.";
  const auto image = decode_grey(Bytes(text.begin(), text.end()), "list.jpg");
  ASSERT_FALSE(image.ok());
  EXPECT_THAT(image.error().sentence, HasSubstr("'list.jpg' is not a JPEG photo"));
  const auto empty = decode_grey({}, "nothing.jpg");
  ASSERT_FALSE(empty.ok());
  EXPECT_THAT(empty.error().sentence, HasSubstr("'nothing.jpg' is empty"));
}

TEST(Jpeg, RefusesAHugePhotoBeforeMakingRoomForIt) {
  Bytes bytes = encode(smooth_picture(16, 16, 1), 90);
  // SOF0 is FF C0, length (2), precision (1), height (2), width (2).
  for (std::size_t i = 0; i + 8 < bytes.size(); ++i) {
    if (bytes[i] != 0xFF || bytes[i + 1] != 0xC0) continue;
    bytes[i + 5] = bytes[i + 7] = 0xF0;
  }
  const auto image = decode_grey(bytes, "huge.jpg");
  ASSERT_FALSE(image.ok());
  EXPECT_THAT(image.error().sentence, HasSubstr("61456 x 61456"));
}

TEST(Jpeg, SurvivesAnyDamage) {
  const Bytes whole = encode(noisy_picture(96, 64), 80);
  std::mt19937 random(11);
  for (int trial = 0; trial < 3000; ++trial) {
    Bytes bytes = whole;
    for (auto flips = 1 + random() % 8; flips > 0; --flips) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    const auto image = decode_grey(bytes, "a.jpg");
    if (image.ok()) {
      EXPECT_EQ(image->data.size(), static_cast<std::size_t>(image->width_px) *
                                        static_cast<std::size_t>(image->height_px));
    }
  }
}

TEST(Jpeg, WritesTheSameBytesForTheSameImage) {
  const Image image = noisy_picture(200, 150);
  EXPECT_EQ(encode(image, 92), encode(image, 92));
}

std::filesystem::path shared_folder() {
  const char* const set = std::getenv("PLUMBLINE_SHARED");
  return set ? std::filesystem::path(set)
             : std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "../shared";
}

TEST(Jpeg, ReadsEveryRealPhoto) {
  const std::filesystem::path data = shared_folder() / "data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no real photos in " << data;
  int photos = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".jpg" && ending != ".JPG") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const Bytes bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const auto image = decode_grey(bytes, entry.path().filename().string());
    EXPECT_TRUE(image.ok()) << image.error().sentence;
    const Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2));
    EXPECT_FALSE(decode_grey(part, "half").ok());
    ++photos;
  }
  EXPECT_GT(photos, 0);
}

}  // namespace
}  // namespace plumbline::jpeg
