// SPDX-License-Identifier: MIT
#include "edge/jpeg/huffman_tables.h"

#include <gtest/gtest.h>

#include <cstdio>
// jpeglib.h needs it before.
#include <jpeglib.h>

#include <algorithm>
#include <random>

#include "edge/jpeg/jpeg.h"

namespace plumbline::jpeg {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Every table is used by noise.
Image noise(int channels) {
  Image image{64, 48, channels, Bytes(static_cast<std::size_t>(64 * 48 * channels))};
  std::mt19937 random(3);
  for (std::uint8_t& value : image.data) value = static_cast<std::uint8_t>(random());
  return image;
}

// As a camera sends it: without the segments of tables.
Bytes stripped(const Bytes& file) {
  Bytes frame(file.begin(), file.begin() + 2);
  std::size_t at = 2;
  while (file[at + 1] != 0xDA) {
    const std::size_t next = at + 2 + static_cast<std::size_t>(file[at + 2] * 256 + file[at + 3]);
    if (file[at + 1] != 0xC4) {
      frame.insert(frame.end(), file.begin() + static_cast<std::ptrdiff_t>(at),
                   file.begin() + static_cast<std::ptrdiff_t>(next));
    }
    at = next;
  }
  frame.insert(frame.end(), file.begin() + static_cast<std::ptrdiff_t>(at), file.end());
  return frame;
}

// A file's tables as libjpeg has read them from its header, before it would help itself.
struct Header {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};

  explicit Header(const Bytes& file) {
    info.err = jpeg_std_error(&errors);
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, file.data(), file.size());
    jpeg_read_header(&info, TRUE);
  }
  ~Header() { jpeg_destroy_decompress(&info); }
  Header(const Header&) = delete;
  Header& operator=(const Header&) = delete;

  // Of number `i`; empty where the file has none. `dc`: the class.
  Bytes table(bool dc, int i) const {
    const JHUFF_TBL* table = dc ? info.dc_huff_tbl_ptrs[i] : info.ac_huff_tbl_ptrs[i];
    if (table == nullptr) return {};
    Bytes bytes(table->bits + 1, table->bits + 17);
    int values = 0;
    for (const std::uint8_t count : bytes) values += count;
    bytes.insert(bytes.end(), table->huffval, table->huffval + values);
    return bytes;
  }
};

TEST(HuffmanTables, ArePutIntoAFrameThatHasNone) {
  const Bytes frame = stripped(encode(noise(3), 90));
  EXPECT_TRUE(Header(frame).table(true, 0).empty()) << "the frame must have none to begin with";
  const Bytes file = with_huffman_tables(frame);
  const Header header(file);
  const Header reference(encode(noise(3), 90));  // libjpeg's own are those of the standard
  for (const bool dc : {true, false}) {
    for (const int i : {0, 1}) {
      ASSERT_FALSE(header.table(dc, i).empty());
      EXPECT_EQ(header.table(dc, i), reference.table(dc, i)) << (dc ? "DC " : "AC ") << i;
    }
  }
}

TEST(HuffmanTables, LetTheFrameBeReadAsItWasWritten) {
  for (const int channels : {1, 3}) {
    const Bytes whole = encode(noise(channels), 90);
    const auto expected = decode_rgb(whole, "whole");
    const auto read = decode_rgb(with_huffman_tables(stripped(whole)), "frame");
    ASSERT_TRUE(read) << read.error().sentence;
    EXPECT_EQ(read->data, expected->data);
  }
}

TEST(HuffmanTables, AreNotPutWhereTheJpegHasItsOwn) {
  const Bytes whole = encode(noise(3), 90);
  EXPECT_EQ(with_huffman_tables(whole), whole);
}

TEST(HuffmanTables, AreFoundAPlaceBehindFillAndStrayBytes) {
  Bytes frame = stripped(encode(noise(3), 90));
  const Bytes between = {0x00, 0x12, 0xFF, 0xFF};
  const std::size_t second = 4 + static_cast<std::size_t>(frame[4] * 256 + frame[5]);
  frame.insert(frame.begin() + static_cast<std::ptrdiff_t>(second), between.begin(), between.end());
  EXPECT_FALSE(Header(with_huffman_tables(frame)).table(false, 1).empty());
}

TEST(HuffmanTables, LeaveWhatHasNoScanAlone) {
  for (const Bytes& bytes : {Bytes{}, Bytes{0xFF, 0xD8}, Bytes{0xFF, 0xD8, 0xFF, 0xD9},
                             Bytes{0xFF, 0xD8, 0xFF, 0xE0, 0xFF, 0xFF, 0x00}}) {
    EXPECT_EQ(with_huffman_tables(bytes), bytes);
  }
}

}  // namespace
}  // namespace plumbline::jpeg
