// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/orientation.h"

#include <gtest/gtest.h>
#include <webp/encode.h>
#include <zlib.h>

#include "lightwell/base/random.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

using File = std::vector<uint8_t>;

const Image picture{8, 4, 3, File(96, 77)};

void append(File& file, const File& part) {
  for (const uint8_t byte : part) file.push_back(byte);
}

void append(File& file, std::string_view text) {
  for (const char c : text) file.push_back(static_cast<uint8_t>(c));
}

void append(File& file, uint64_t value, int size, bool big) {
  for (int i = 0; i < size; i++) file.push_back(static_cast<uint8_t>(value >> (8 * (big ? size - 1 - i : i))));
}

/// The file with a part put in at a place.
File with(const File& file, size_t at, const File& part) {
  File longer(file.begin(), file.begin() + static_cast<ptrdiff_t>(at));
  append(longer, part);
  for (size_t i = at; i < file.size(); i++) longer.push_back(file[i]);
  return longer;
}

/// A TIFF file with a resolution's unit and an orientation.
File exif(int orientation, bool big) {
  File tiff;
  append(tiff, big ? std::string_view("MM\0*", 4) : std::string_view("II*\0", 4));
  append(tiff, 8, 4, big);
  append(tiff, 2, 2, big);
  for (const auto& [tag, value] : {std::pair(0x0128, 2), std::pair(0x0112, orientation)}) {
    append(tiff, static_cast<uint64_t>(tag), 2, big);
    append(tiff, 3, 2, big);
    append(tiff, 1, 4, big);
    append(tiff, static_cast<uint64_t>(value), 2, big);
    append(tiff, 0, 2, big);
  }
  append(tiff, 0, 4, big);
  return tiff;
}

File jpeg(const File& tiff) {
  File segment;
  append(segment, 0xffe1, 2, true);
  append(segment, tiff.size() + 8, 2, true);
  append(segment, std::string_view("Exif\0\0", 6));
  append(segment, tiff);
  return with(write_jpeg(picture, 90), 2, segment);
}

File png(const File& tiff) {
  File named;
  append(named, "eXIf");
  append(named, tiff);
  File chunk;
  append(chunk, tiff.size(), 4, true);
  append(chunk, named);
  append(chunk, crc32(0, named.data(), static_cast<uInt>(named.size())), 4, true);
  return with(write_png(picture), 33, chunk);  // behind IHDR
}

File webp(const File& tiff) {
  uint8_t* bytes = nullptr;
  const size_t length = WebPEncodeLosslessRGB(picture.pixels.data(), picture.width, picture.height, 24, &bytes);
  File file;
  for (size_t i = 0; i < length; i++) file.push_back(bytes[i]);
  WebPFree(bytes);
  File extended;
  append(extended, "VP8X");
  append(extended, 10, 4, false);
  append(extended, 8, 4, false);  // has Exif data
  append(extended, 7, 3, false);
  append(extended, 3, 3, false);
  file = with(file, 12, extended);
  append(file, "EXIF");
  append(file, tiff.size(), 4, false);
  append(file, tiff);
  for (size_t i = 0; i < 4; i++) file[4 + i] = static_cast<uint8_t>((file.size() - 8) >> (8 * i));
  return file;
}

TEST(Orientation, IsTakenOutOfEveryFormat) {
  for (const auto& make : {jpeg, png, webp})
    for (const bool big : {false, true}) {
      File file = make(exif(6, big));
      EXPECT_TRUE(make_upright(file));
      EXPECT_EQ(file, make(exif(1, big)));  // and nothing else is changed
      EXPECT_FALSE(make_upright(file));
      const auto image = read_image_file(file);
      ASSERT_TRUE(image) << image.error().message();
      EXPECT_EQ(image->width, picture.width);
    }
}

TEST(Orientation, OfOtherFilesIsLeft) {
  for (File file : {write_jpeg(picture, 90), write_png(picture), File(), File{0xff, 0xd8, 0xff}}) {
    const File before = file;
    EXPECT_FALSE(make_upright(file));
    EXPECT_EQ(file, before);
  }
}

TEST(Orientation, SurvivesDamage) {
  Random random(9, 0);
  for (const auto& make : {jpeg, png, webp}) {
    const File whole = make(exif(6, true));
    for (size_t size = 0; size < whole.size(); size++) {
      File cut(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size));
      make_upright(cut);
    }
    for (int i = 0; i < 2000; i++) {
      File damaged = whole;
      for (int n = 0; n < 4; n++)
        damaged[random.below(static_cast<uint32_t>(whole.size()))] = static_cast<uint8_t>(random.below(256));
      make_upright(damaged);
    }
  }
}

}  // namespace
}  // namespace lightwell
