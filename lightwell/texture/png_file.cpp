// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <memory>

#include "lightwell/base/assert.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

// libpng reports an error by a jump. Everything that owns memory lives in these structs, outside the functions that set
// the jump's target, so that no destructor is jumped over.
struct Reading {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ByteReader reader;
  std::string error;
  uint64_t stored_stride = 0;  ///< bytes of a row before expansion
  Image image;
  std::vector<png_bytep> rows;

  explicit Reading(Bytes file) : reader(file) {}
  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
};

// A byte of a deflate stream stands for at most this many.
constexpr uint64_t most_inflation = 1032;

struct Writing {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<uint8_t> bytes;

  Writing() = default;
  ~Writing() { png_destroy_write_struct(&png, &info); }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
};

[[noreturn]] void on_read_error(png_structp png, png_const_charp message) {
  static_cast<Reading*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep out, size_t count) {
  const Bytes bytes = static_cast<Reading*>(png_get_io_ptr(png))->reader.take(count);
  if (bytes.size() != count) png_error(png, "the file ends too early");
  std::copy(bytes.begin(), bytes.end(), out);
}

void write_bytes(png_structp png, png_bytep bytes, size_t count) {
  auto* writing = static_cast<Writing*>(png_get_io_ptr(png));
  writing->bytes.insert(writing->bytes.end(), bytes, bytes + count);
}

/// Reads the header; its size is checked by the caller. False after an error.
bool read_header(Reading& r) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  png_set_read_fn(r.png, &r, read_bytes);
  png_set_user_limits(r.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_read_info(r.png, r.info);
  r.stored_stride = png_get_rowbytes(r.png, r.info);
  return true;
}

/// Asks for 8-bit channels. False after an error.
bool expand(Reading& r) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  png_set_expand(r.png);
  png_set_scale_16(r.png);
  png_set_interlace_handling(r.png);
  png_read_update_info(r.png, r.info);
  return true;
}

bool read_rows(Reading& r) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  png_read_image(r.png, r.rows.data());
  return true;
}

}  // namespace

Result<Image> read_png(Bytes file, ImageLimit limit) {
  Reading r(file);
  r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, on_read_error, on_warning);
  r.info = r.png ? png_create_info_struct(r.png) : nullptr;
  if (!r.info) return fail("PNG", "out of memory");
  if (!read_header(r)) return fail("PNG", r.error);
  const size_t width = png_get_image_width(r.png, r.info), height = png_get_image_height(r.png, r.info);
  LW_CHECK(check_image_size(width, height, limit));
  if (r.stored_stride * height > file.size() * most_inflation) return fail("PNG", "the file is too short for its size");
  if (!expand(r)) return fail("PNG", r.error);
  r.image = {static_cast<int>(width), static_cast<int>(height), png_get_channels(r.png, r.info), {}};
  const size_t stride = png_get_rowbytes(r.png, r.info);
  LW_ASSERT(stride == width * static_cast<size_t>(r.image.channels));
  r.image.pixels.resize(stride * height);
  for (size_t y = 0; y < height; y++) r.rows.push_back(&r.image.pixels[y * stride]);
  if (!read_rows(r)) return fail("PNG", r.error);
  return std::move(r.image);
}

std::vector<uint8_t> write_png(const Image& image) {
  constexpr int color_types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                 PNG_COLOR_TYPE_RGB_ALPHA};
  LW_ASSERT(
      image.channels >= 1 && image.channels <= 4 &&
      check_image_size(static_cast<uint64_t>(image.width), static_cast<uint64_t>(image.height), highest_image_limit));
  Writing w;
  w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, on_warning);
  w.info = w.png ? png_create_info_struct(w.png) : nullptr;
  LW_ASSERT(w.info);
  if (setjmp(png_jmpbuf(w.png))) std::abort();  // nothing but a lack of memory can fail
  png_set_write_fn(w.png, &w, write_bytes, nullptr);
  png_set_IHDR(w.png, w.info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               color_types[image.channels - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(w.png, w.info);
  const size_t stride = image.pixels.size() / static_cast<size_t>(image.height);
  for (size_t y = 0; y < static_cast<size_t>(image.height); y++) png_write_row(w.png, &image.pixels[y * stride]);
  png_write_end(w.png, w.info);
  return std::move(w.bytes);
}

}  // namespace lightwell
