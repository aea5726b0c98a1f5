// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace plumbline::pixels {

// The tags of a TIFF file (TIFF 6.0, section 2) of one image in one uncompressed strip,
// little-endian. A tag that is set again takes the new value; a value is one number or several.
// Written here because a raw file needs no more of TIFF than this, and libtiff would bring seven
// libraries of compression into the program that flies.
class TiffDirectory {
 public:
  void set_bytes(std::uint16_t tag, std::vector<std::uint8_t> values);
  void set_text(std::uint16_t tag, const std::string& text);  // ends at its first zero
  void set_shorts(std::uint16_t tag, const std::vector<std::uint16_t>& values);
  void set_longs(std::uint16_t tag, const std::vector<std::uint32_t>& values);
  // To 1e-6 where they are below 2000, else to 1e-4: values of at least 0 and below 400 000, and of
  // either sign below 200 000.
  void set_ratios(std::uint16_t tag, const std::vector<double>& values);
  void set_signed_ratios(std::uint16_t tag, const std::vector<double>& values);

  // The file: its header, these tags with StripOffsets and StripByteCounts, then the pixels, which
  // together with them are below 4 GB.
  std::vector<std::uint8_t> file_with(std::vector<std::uint8_t> pixels) const;

 private:
  struct Entry {
    std::uint16_t type = 0;
    std::uint32_t count = 0;
    std::vector<std::uint8_t> bytes;
  };

  std::map<std::uint16_t, Entry> entries_;  // TIFF wants them in order
};

}  // namespace plumbline::pixels
