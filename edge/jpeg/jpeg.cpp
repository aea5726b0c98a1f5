// SPDX-License-Identifier: MIT
#include "edge/jpeg/jpeg.h"

// jpeglib.h wants FILE and size_t declared before it.
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
//
#include <jerror.h>
#include <jpeglib.h>

namespace plumbline::jpeg {
namespace {

constexpr int kMaxPaddingBytes = 64;
constexpr int kMaxScans = 500;

struct Failure {
  int code = 0;
  char text[JMSG_LENGTH_MAX] = "";
};

// libjpeg reports errors by a callback that must not return. The callback jumps back into
// guarded(); between there and here stand only C frames and lambdas without anything to destroy.
struct ErrorManager {
  jpeg_error_mgr base;  // first: libjpeg hands back a pointer to it
  std::jmp_buf escape;
  Failure failure;
  bool in_scan_data;
};

[[noreturn]] void fail(j_common_ptr info) {
  auto* manager = reinterpret_cast<ErrorManager*>(info->err);
  manager->failure.code = info->err->msg_code;
  (*info->err->format_message)(info, manager->failure.text);
  std::longjmp(manager->escape, 1);
}

// "%u extraneous bytes before marker 0x%02x": seen in sound files of real cameras between header
// segments and as padding before the end-of-image marker; anywhere else data were lost.
bool is_harmless(j_common_ptr info) {
  if (info->err->msg_code != JWRN_EXTRANEOUS_DATA) return false;
  if (!reinterpret_cast<ErrorManager*>(info->err)->in_scan_data) return true;
  return info->err->msg_parm.i[0] <= kMaxPaddingBytes && info->err->msg_parm.i[1] == JPEG_EOI;
}

void on_message(j_common_ptr info, int level) {
  if (level < 0 && !is_harmless(info)) fail(info);
}

void ignore_output(j_common_ptr) {}

void init(ErrorManager& manager) {
  jpeg_std_error(&manager.base);
  manager.base.error_exit = fail;
  manager.base.emit_message = on_message;
  manager.base.output_message = ignore_output;
  manager.in_scan_data = false;
}

template <typename Calls>
bool guarded(ErrorManager& manager, const Calls& calls) {
  if (setjmp(manager.escape) != 0) return false;
  calls();
  return true;
}

// A progressive file may hold any number of scans, each as costly as a whole photo.
void refuse_endless_scans(j_common_ptr info) {
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMaxScans) {
    info->err->msg_code = JERR_BAD_PROGRESSION;
    fail(info);
  }
}

class Decoder {
 public:
  Decoder() {
    init(manager_);
    info_.err = &manager_.base;
    created_ = guarded(manager_, [this] { jpeg_create_decompress(&info_); });
    progress_.progress_monitor = refuse_endless_scans;
    info_.progress = &progress_;
  }
  ~Decoder() {
    if (created_) jpeg_destroy_decompress(&info_);
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  bool open(std::span<const std::uint8_t> bytes) {
    return created_ && guarded(manager_, [this, bytes] {
             jpeg_mem_src(&info_, bytes.data(), static_cast<unsigned long>(bytes.size()));
             jpeg_read_header(&info_, TRUE);
           });
  }

  JpegHeader header() const {
    return {static_cast<int>(info_.image_width), static_cast<int>(info_.image_height),
            info_.num_components};
  }

  // `pixels` has width * height * channels bytes.
  bool read(J_COLOR_SPACE colours, std::uint8_t* pixels, std::size_t row_bytes) {
    return guarded(manager_, [this, colours, pixels, row_bytes] {
      manager_.in_scan_data = true;
      info_.out_color_space = colours;
      jpeg_start_decompress(&info_);
      while (info_.output_scanline < info_.output_height) {
        JSAMPROW row = pixels + info_.output_scanline * row_bytes;
        jpeg_read_scanlines(&info_, &row, 1);
      }
      jpeg_finish_decompress(&info_);  // reads on to the end-of-image marker
    });
  }

  const Failure& failure() const { return manager_.failure; }

 private:
  ErrorManager manager_{};
  jpeg_progress_mgr progress_{};
  jpeg_decompress_struct info_{};
  bool created_ = false;
};

Error explain(const Failure& failure, const std::string& name) {
  const std::string detail = failure.text;
  if (failure.code == JERR_NO_SOI) {
    return {"'" + name + "' is not a JPEG photo (" + detail + "); remove it or convert it."};
  }
  return {"Photo '" + name + "' is damaged or cut short (" + detail +
          "); copy it again from the card or leave it out."};
}

Status check_size(const JpegHeader& header, const std::string& name) {
  const std::int64_t pixels = static_cast<std::int64_t>(header.width_px) * header.height_px;
  if (pixels <= kMaxPixels) return Done{};
  return Error{"Photo '" + name + "' claims " + std::to_string(header.width_px) + " x " +
               std::to_string(header.height_px) + " pixels, more than the " +
               std::to_string(kMaxPixels / 1'000'000) +
               " million that are accepted; leave it out or make it smaller."};
}

Status open(Decoder& decoder, std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.empty()) return Error{"Photo '" + name + "' is empty; copy it again from the card."};
  if (!decoder.open(bytes)) return explain(decoder.failure(), name);
  return check_size(decoder.header(), name);
}

Result<Image> decode(std::span<const std::uint8_t> bytes, const std::string& name,
                     J_COLOR_SPACE colours, int channels) {
  Decoder decoder;
  if (const Status opened = open(decoder, bytes, name); !opened) return opened.error();
  Image image{decoder.header().width_px, decoder.header().height_px, channels, {}};
  const std::size_t row_bytes =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(channels);
  image.data.resize(row_bytes * static_cast<std::size_t>(image.height_px));
  if (!decoder.read(colours, image.data.data(), row_bytes)) {
    return explain(decoder.failure(), name);
  }
  return image;
}

}  // namespace

Result<JpegHeader> read_header(std::span<const std::uint8_t> bytes, const std::string& name) {
  Decoder decoder;
  if (const Status opened = open(decoder, bytes, name); !opened) return opened.error();
  return decoder.header();
}

Result<Image> decode_grey(std::span<const std::uint8_t> bytes, const std::string& name) {
  return decode(bytes, name, JCS_GRAYSCALE, 1);
}

Result<Image> decode_rgb(std::span<const std::uint8_t> bytes, const std::string& name) {
  return decode(bytes, name, JCS_RGB, 3);
}

namespace {

struct Encoder {
  jpeg_compress_struct info{};
  ErrorManager manager{};
  unsigned char* bytes = nullptr;
  unsigned long size_bytes = 0;

  Encoder() {
    init(manager);
    info.err = &manager.base;
  }
  ~Encoder() {
    jpeg_destroy_compress(&info);
    std::free(bytes);
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  void begin(const JpegHeader& size, J_COLOR_SPACE colours, int quality) {
    jpeg_create_compress(&info);
    jpeg_mem_dest(&info, &bytes, &size_bytes);
    info.image_width = static_cast<JDIMENSION>(size.width_px);
    info.image_height = static_cast<JDIMENSION>(size.height_px);
    info.input_components = size.channels;
    info.in_color_space = colours;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, quality, TRUE);
  }

  // `row_of(v)` hands out row v; nothing in it may need destroying while libjpeg runs.
  template <typename RowOf>
  void write_rows(const RowOf& row_of) {
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < info.image_height) {
      const std::uint8_t* start = row_of(static_cast<int>(info.next_scanline));
      JSAMPROW row = const_cast<JSAMPROW>(start);  // libjpeg does not write to it
      jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
  }

  void write(const Image& image, int quality) {
    begin({image.width_px, image.height_px, image.channels},
          image.channels == 3 ? JCS_RGB : JCS_GRAYSCALE, quality);
    write_rows([&image](int v) { return image.data.data() + image.index(0, v); });
  }
};

}  // namespace

std::vector<std::uint8_t> encode(const Image& image, int quality) {
  const std::size_t expected = static_cast<std::size_t>(image.width_px) *
                               static_cast<std::size_t>(image.height_px) *
                               static_cast<std::size_t>(image.channels);
  if (image.empty() || image.data.size() != expected ||
      (image.channels != 1 && image.channels != 3))
    std::abort();
  Encoder encoder;
  if (!guarded(encoder.manager, [&] { encoder.write(image, quality); })) std::abort();
  return {encoder.bytes, encoder.bytes + encoder.size_bytes};
}

std::vector<std::uint8_t> encode_ycbcr(const JpegHeader& size, ChromaSampling sampling, int quality,
                                       const YcbcrRows& rows) {
  if (size.width_px < 1 || size.height_px < 1 || size.channels != 3) std::abort();
  std::vector<std::uint8_t> row(3 * static_cast<std::size_t>(size.width_px));
  Encoder encoder;
  const bool written = guarded(encoder.manager, [&] {
    encoder.begin(size, JCS_YCbCr, quality);
    encoder.info.comp_info[0].h_samp_factor = 2;
    encoder.info.comp_info[0].v_samp_factor = sampling == ChromaSampling::kHalfBoth ? 2 : 1;
    encoder.write_rows([&](int v) {
      rows(v, row.data());
      return row.data();
    });
  });
  if (!written) std::abort();
  return {encoder.bytes, encoder.bytes + encoder.size_bytes};
}

}  // namespace plumbline::jpeg
