// SPDX-License-Identifier: MIT
#include "firmware/ingest/sensor_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace plumbline::ingest {
namespace {

struct Sensor {
  const char* model;  // lower case, as in EXIF
  double long_side_mm;
};

// From the makers' data sheets (sensor size, or pixel pitch times pixels). Where a maker gives only
// an inch class, the width that agrees with the stated focal length, real and 35 mm equivalent.
constexpr std::array kSensors = {
    // DJI, 1/2.3 inch: Phantom 2 Vision+, 3, 4, Inspire 1, Mavic Pro, Air, Mini, 2 Zoom
    Sensor{"fc200", 6.17}, Sensor{"fc300c", 6.17}, Sensor{"fc300s", 6.17}, Sensor{"fc300x", 6.17},
    Sensor{"fc300se", 6.17}, Sensor{"fc330", 6.25}, Sensor{"fc350", 6.17}, Sensor{"fc350z", 6.17},
    Sensor{"fc220", 6.17}, Sensor{"fc2103", 6.25}, Sensor{"fc7203", 6.3}, Sensor{"fc7303", 6.3},
    Sensor{"fc2204", 6.3}, Sensor{"zh20", 6.3}, Sensor{"zh20t", 6.3},
    // DJI, 1/2 and 1/1.3 inch: Mavic Air 2, M30, Mavic 3T, Mini 3 Pro, Mini 4 Pro
    Sensor{"fc3170", 6.4}, Sensor{"m30", 6.4}, Sensor{"m30t", 6.4}, Sensor{"m3t", 6.4},
    Sensor{"fc3582", 9.65}, Sensor{"fc8482", 9.65},
    // DJI, 1 inch: Phantom 4 Pro, Advanced, RTK, Air 2S, X4S, L1; Mavic 2 Pro
    Sensor{"fc6310", 13.2}, Sensor{"fc6310s", 13.2}, Sensor{"fc6310r", 13.2},
    Sensor{"fc6310e", 13.2}, Sensor{"fc3411", 13.2}, Sensor{"fc6510", 13.2},
    Sensor{"zenmusel1", 13.2}, Sensor{"l1d-20c", 13.2},
    // DJI, 4/3 inch and larger: X5, X5S, Mavic 3 and 3 Enterprise, L2; X7; P1
    Sensor{"fc550", 17.3}, Sensor{"fc550raw", 17.3}, Sensor{"fc6520", 17.3},
    Sensor{"l2d-20c", 17.3}, Sensor{"m3e", 17.3}, Sensor{"m3m", 17.3}, Sensor{"zenmusel2", 17.3},
    Sensor{"fc6540", 23.5}, Sensor{"zenmusep1", 35.9},
    // DJI, infrared, 17 um; Phantom 4 Multispectral
    Sensor{"xt", 10.88}, Sensor{"fc6360", 4.87},
    // Parrot, senseFly, Yuneec
    Sensor{"anafi", 5.985}, Sensor{"anafithermal", 5.985}, Sensor{"anafiusa", 5.985},
    Sensor{"sequoia", 6.17}, Sensor{"s.o.d.a.", 12.75}, Sensor{"e90", 13.2},
    // Sony
    Sensor{"dsc-rx1rm2", 35.9}, Sensor{"dsc-rx1r", 35.8}, Sensor{"ilce-7r", 35.9},
    Sensor{"ilce-7rm2", 35.9}, Sensor{"ilce-7rm3", 35.9}, Sensor{"ilce-7rm4", 35.7},
    Sensor{"ilce-7rm4a", 35.7}, Sensor{"ilce-7m3", 35.6}, Sensor{"ilce-5000", 23.2},
    Sensor{"ilce-5100", 23.5}, Sensor{"ilce-6000", 23.5}, Sensor{"ilce-6100", 23.5},
    Sensor{"ilce-6300", 23.5}, Sensor{"ilce-6400", 23.5}, Sensor{"ilce-6500", 23.5},
    Sensor{"ilce-qx1", 23.2}, Sensor{"umc-r10c", 23.2}, Sensor{"nex-5t", 23.5},
    Sensor{"nex-7", 23.5}, Sensor{"dsc-rx100", 13.2}, Sensor{"dsc-rx100m2", 13.2},
    Sensor{"dsc-rx100m3", 13.2}, Sensor{"dsc-rx0", 13.2}, Sensor{"dsc-wx220", 6.17},
    // Canon, Nikon, Fujifilm, Panasonic, Ricoh, GoPro
    Sensor{"canon powershot sx260 hs", 6.17}, Sensor{"canon powershot sx230 hs", 6.17},
    Sensor{"canon powershot s100", 7.44}, Sensor{"canon powershot s110", 7.44},
    Sensor{"canon powershot g9 x", 13.2}, Sensor{"canon powershot elph 110 hs", 6.17},
    Sensor{"canon eos m", 22.3}, Sensor{"canon eos m10", 22.3},
    Sensor{"canon eos 5d mark ii", 36.0}, Sensor{"canon eos 5ds r", 36.0},
    Sensor{"canon eos r5", 36.0}, Sensor{"nikon d800", 35.9}, Sensor{"nikon d850", 35.9},
    Sensor{"coolpix a", 23.6}, Sensor{"gfx100s", 43.8}, Sensor{"dmc-gh4", 17.3}, Sensor{"gr", 23.7},
    Sensor{"gr ii", 23.7}, Sensor{"ricoh gr iii", 23.5}, Sensor{"hero4 black", 6.17},
    Sensor{"hero5 black", 6.17}};

// Raspberry Pi cameras name the path of the device: "/base/soc/i2c0mux/i2c@1/imx477@1a".
constexpr std::array kChips = {Sensor{"imx477", 6.287}, Sensor{"imx708", 6.451},
                               Sensor{"imx219", 3.674}, Sensor{"ov5647", 3.629},
                               Sensor{"imx296", 5.023}};

std::string lower_case(const std::string& text) {
  std::string lower = text;
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace

std::optional<double> sensor_long_side_mm(const std::string& make, const std::string& model) {
  const std::string name = lower_case(model);
  for (const Sensor& sensor : kSensors) {
    if (name == sensor.model) return sensor.long_side_mm;
  }
  if (lower_case(make).find("raspberry") == std::string::npos) return std::nullopt;
  for (const Sensor& chip : kChips) {
    if (name.find(chip.model) != std::string::npos) return chip.long_side_mm;
  }
  return std::nullopt;
}

}  // namespace plumbline::ingest
