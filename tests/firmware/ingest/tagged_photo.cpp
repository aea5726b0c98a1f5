// SPDX-License-Identifier: MIT
#include "tests/firmware/ingest/tagged_photo.h"

#include <exiv2/exiv2.hpp>
#include <random>

#include "edge/jpeg/jpeg.h"

namespace plumbline::ingest {

std::vector<std::uint8_t> tagged_photo(const PhotoContent& content) {
  Image image{content.width_px, content.height_px, 1, {}};
  std::mt19937 random(content.seed);
  image.data.resize(static_cast<std::size_t>(content.width_px * content.height_px));
  for (std::uint8_t& value : image.data) value = static_cast<std::uint8_t>(random() % 256);
  const std::vector<std::uint8_t> plain = jpeg::encode(image, 90);

  const auto photo = Exiv2::ImageFactory::open(plain.data(), static_cast<long>(plain.size()));
  photo->readMetadata();
  Exiv2::ExifData exif;
  for (const auto& [key, value] : content.exif) exif[key] = value;
  photo->setExifData(exif);
  Exiv2::XmpProperties::registerNs("http://www.dji.com/drone-dji/1.0/", "drone-dji");
  Exiv2::XmpProperties::registerNs("http://pix4d.com/camera/1.0/", "Camera");
  Exiv2::XmpData xmp;
  for (const auto& [key, value] : content.xmp) xmp[key] = value;
  photo->setXmpData(xmp);
  photo->writeMetadata();
  Exiv2::BasicIo& io = photo->io();
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(io.size()));
  io.open();
  io.seek(0, Exiv2::BasicIo::beg);
  io.read(bytes.data(), static_cast<long>(bytes.size()));
  return bytes;
}

std::map<std::string, std::string> exif_position() {
  return {
      {"Exif.GPSInfo.GPSLatitudeRef", "N"},  {"Exif.GPSInfo.GPSLatitude", "35/1 21/1 405/10"},
      {"Exif.GPSInfo.GPSLongitudeRef", "E"}, {"Exif.GPSInfo.GPSLongitude", "139/1 7/1 5225/100"},
      {"Exif.GPSInfo.GPSAltitudeRef", "0"},  {"Exif.GPSInfo.GPSAltitude", "12345/100"}};
}

}  // namespace plumbline::ingest
