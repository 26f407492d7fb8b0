// SPDX-License-Identifier: Apache-2.0
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
// jpeglib.h needs what cstdio declares.
#include <jpeglib.h>
// jerror.h needs jpeglib.h.
#include <jerror.h>

#include "lightwell/base/assert.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

// More scans than any encoder makes; a hostile progressive file has thousands of empty ones, each of which costs a pass
// over the image.
constexpr int max_scans = 500;

// Every block of 8 x 8 pixels takes a bit at least, in the scan that begins it.
constexpr uint64_t most_pixels_a_byte = 8 * 64;

// libjpeg reports an error by calling error_exit, which must not return: it jumps. Everything that owns memory lives in
// these structs, outside the functions that set the jump's target.
struct ErrorHandler {
  jpeg_error_mgr manager{};
  std::jmp_buf target;
  std::string message;
  bool short_of_data = false;
};

[[noreturn]] void on_error(j_common_ptr codec) {
  auto* handler = reinterpret_cast<ErrorHandler*>(codec->err);
  char text[JMSG_LENGTH_MAX];
  codec->err->format_message(codec, text);
  handler->message = text;
  std::longjmp(handler->target, 1);
}

// libjpeg fills in what a truncated file lacks and only warns. Its other warnings are about oddities that decode well.
void on_message(j_common_ptr codec, int level) {
  const int code = codec->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER))
    reinterpret_cast<ErrorHandler*>(codec->err)->short_of_data = true;
}

struct Reading {
  ErrorHandler handler;
  jpeg_decompress_struct codec{};
  jpeg_progress_mgr progress{};
  Image image;

  Reading() {
    codec.err = jpeg_std_error(&handler.manager);
    handler.manager.error_exit = on_error;
    handler.manager.emit_message = on_message;
  }
  ~Reading() { jpeg_destroy_decompress(&codec); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
};

struct Writing {
  jpeg_error_mgr manager{};
  jpeg_compress_struct codec{};
  unsigned char* bytes = nullptr;
  unsigned long size = 0;

  Writing() { codec.err = jpeg_std_error(&manager); }
  ~Writing() {
    jpeg_destroy_compress(&codec);
    std::free(bytes);
  }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
};

void limit_scans(j_common_ptr codec) {
  if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number <= max_scans) return;
  auto* handler = reinterpret_cast<ErrorHandler*>(codec->err);
  handler->message = "too many scans";
  std::longjmp(handler->target, 1);
}

/// Reads the header and chooses what the decoder is to produce. False after an error.
bool start(Reading& r, Bytes file) {
  if (setjmp(r.handler.target)) return false;
  jpeg_create_decompress(&r.codec);
  r.progress.progress_monitor = limit_scans;
  r.codec.progress = &r.progress;
  jpeg_mem_src(&r.codec, file.data(), file.size());
  jpeg_read_header(&r.codec, TRUE);
  if (r.codec.num_components == 3) r.codec.out_color_space = JCS_RGB;
  if (r.codec.num_components == 4) r.codec.out_color_space = JCS_CMYK;
  return true;
}

/// Decodes into r.image, whose pixels have the right size. False after an error.
bool read_rows(Reading& r) {
  if (setjmp(r.handler.target)) return false;
  jpeg_start_decompress(&r.codec);
  const size_t stride = static_cast<size_t>(r.codec.output_width) * static_cast<size_t>(r.codec.output_components);
  LW_ASSERT(stride * r.codec.output_height == r.image.pixels.size());
  while (r.codec.output_scanline < r.codec.output_height) {
    JSAMPROW row = &r.image.pixels[r.codec.output_scanline * stride];
    jpeg_read_scanlines(&r.codec, &row, 1);
  }
  return true;
}

/// RGB of CMYK without a profile: (1 - ink) (1 - black). Adobe's files hold the complements.
Image rgb_of_cmyk(const Image& cmyk, bool complemented) {
  Image rgb{cmyk.width, cmyk.height, 3, {}};
  rgb.pixels.reserve(cmyk.pixels.size() / 4 * 3);
  const auto paper = [&](uint8_t ink) { return complemented ? ink : 255 - ink; };
  for (size_t i = 0; i < cmyk.pixels.size(); i += 4) {
    for (size_t c = 0; c < 3; c++)
      rgb.pixels.push_back(static_cast<uint8_t>((paper(cmyk.pixels[i + c]) * paper(cmyk.pixels[i + 3]) + 127) / 255));
  }
  return rgb;
}

}  // namespace

Result<Image> read_jpeg(Bytes file, ImageLimit limit) {
  Reading r;
  if (!start(r, file)) return fail("JPEG", r.handler.message);
  const int channels = r.codec.num_components;
  if (channels != 1 && channels != 3 && channels != 4)
    return fail(ErrorKind::unsupported, "JPEG", "has " + std::to_string(channels) + " components");
  LW_CHECK(check_image_size(r.codec.image_width, r.codec.image_height, limit));
  if (uint64_t(r.codec.image_width) * r.codec.image_height > file.size() * most_pixels_a_byte)
    return fail("JPEG", "the file is too short for its size");
  r.image = {static_cast<int>(r.codec.image_width), static_cast<int>(r.codec.image_height), channels, {}};
  r.image.pixels.resize(size_t(r.codec.image_width) * r.codec.image_height * static_cast<size_t>(channels));
  if (!read_rows(r)) return fail("JPEG", r.handler.message);
  if (r.handler.short_of_data) return fail("JPEG", "the file is damaged or ends too early");
  if (channels == 4) return rgb_of_cmyk(r.image, r.codec.saw_Adobe_marker);
  return std::move(r.image);
}

std::vector<uint8_t> write_jpeg(const Image& image, int quality) {
  LW_ASSERT(
      (image.channels == 1 || image.channels == 3) &&
      check_image_size(static_cast<uint64_t>(image.width), static_cast<uint64_t>(image.height), highest_image_limit));
  Writing w;
  jpeg_create_compress(&w.codec);
  jpeg_mem_dest(&w.codec, &w.bytes, &w.size);
  w.codec.image_width = static_cast<JDIMENSION>(image.width);
  w.codec.image_height = static_cast<JDIMENSION>(image.height);
  w.codec.input_components = image.channels;
  w.codec.in_color_space = image.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&w.codec);
  w.codec.optimize_coding = TRUE;
  jpeg_set_quality(&w.codec, quality, TRUE);
  jpeg_start_compress(&w.codec, TRUE);
  const size_t stride = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels);
  while (w.codec.next_scanline < w.codec.image_height) {
    auto* row = const_cast<JSAMPROW>(&image.pixels[w.codec.next_scanline * stride]);
    jpeg_write_scanlines(&w.codec, &row, 1);
  }
  jpeg_finish_compress(&w.codec);
  return {w.bytes, w.bytes + w.size};
}

}  // namespace lightwell
