// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/ktx2_file.h"

#include <zstd.h>

#include <array>

#include "lightwell/texture/etc1s_decode.h"
#include "lightwell/texture/image_file.h"
#include "lightwell/texture/texel_block.h"
#include "lightwell/texture/uastc_decode.h"

namespace lightwell {
namespace {

// KTX 2.0, section "File Structure"; the numbers of the data format descriptor are of the Khronos Data Format
// Specification, section "Color models".
constexpr std::string_view identifier = "\xabKTX 20\xbb\r\n\x1a\n";
constexpr size_t level_index_at = 80;
constexpr size_t most_levels = 32;

enum Supercompression : uint32_t { uncompressed = 0, basis_lz = 1, zstandard = 2 };
enum ColorModel : uint8_t { etc1s = 163, uastc = 166 };
enum Etc1sChannel : uint8_t { etc1s_rgb = 0, etc1s_rrr = 3, etc1s_ggg = 4, etc1s_aaa = 15 };
enum UastcChannel : uint8_t { uastc_rgb = 0, uastc_rgba = 3, uastc_rrr = 4, uastc_rg = 6 };

// Runs and Zstandard make much of nothing, so that a small file may claim any size. What needs more memory than this
// many pixels must have bytes to show for it, as every PNG has.
constexpr uint64_t free_pixels = uint64_t(1) << 24;
constexpr uint64_t pixels_per_byte = 1024;

struct Section {
  uint64_t offset = 0, length = 0;
};

struct Header {
  uint32_t format = 0, width = 0, height = 0, depth = 0, layers = 0, faces = 0, levels = 0, supercompression = 0;
  Section descriptor, global_data, level;  ///< the level is the largest
  uint64_t level_uncompressed = 0;
};

/// What the data format descriptor says of the blocks.
struct Descriptor {
  uint8_t model = 0;
  size_t samples = 0;
  std::array<uint8_t, 2> channels{};  ///< of the first samples
};

Result<Header> read_header(Bytes file) {
  if (!is_ktx2(file)) return fail("KTX2", "is no KTX 2.0 file");
  ByteReader reader(file);
  reader.take(identifier.size());
  Header header;
  header.format = reader.u32();
  reader.u32();  // bytes of a number, one in all compressed formats
  header.width = reader.u32();
  header.height = reader.u32();
  header.depth = reader.u32();
  header.layers = reader.u32();
  header.faces = reader.u32();
  header.levels = std::max(reader.u32(), 1u);
  header.supercompression = reader.u32();
  header.descriptor = {reader.u32(), reader.u32()};
  reader.u64();  // where the key/value data is, and its length
  header.global_data = {reader.u64(), reader.u64()};
  header.level = {reader.u64(), reader.u64()};
  header.level_uncompressed = reader.u64();
  if (!reader.ok() || header.levels > most_levels ||
      (file.size() - level_index_at) / (3 * sizeof(uint64_t)) < header.levels)
    return fail("KTX2", "damaged header");
  return header;
}

Result<void> check_kind(const Header& header) {
  if (header.format != 0) return fail(ErrorKind::unsupported, "KTX2", "is not of Basis Universal");
  if (header.depth > 1 || header.layers > 1 || header.faces != 1)
    return fail(ErrorKind::unsupported, "KTX2", "is not a single 2D picture");
  return {};
}

Result<Bytes> bytes_of(Bytes file, const Section& section) {
  if (section.offset > file.size() || section.length > file.size() - section.offset)
    return fail("KTX2", "the file is damaged or ends too early");
  return file.subspan(section.offset, section.length);
}

Result<Descriptor> read_descriptor(Bytes bytes) {
  constexpr size_t block_header = 24, sample_bytes = 16;
  ByteReader reader(bytes);
  reader.u32();  // the length of all blocks
  reader.u32();  // vendor and type of the block
  reader.u16();  // version
  const size_t block_bytes = reader.u16();
  Descriptor descriptor;
  descriptor.model = reader.u8();
  reader.take(3);   // primaries, transfer function and flags, which depend on the use in glTF
  reader.take(12);  // sides of blocks and bytes of planes, which the model implies
  if (block_bytes < block_header + sample_bytes) return fail("KTX2", "damaged data format descriptor");
  descriptor.samples = (block_bytes - block_header) / sample_bytes;
  for (size_t i = 0; i < std::min(descriptor.samples, descriptor.channels.size()); i++) {
    reader.take(3);  // where its bits are
    descriptor.channels[i] = reader.u8() & 15;
    reader.take(12);  // position and range
  }
  if (!reader.ok()) return fail("KTX2", "damaged data format descriptor");
  return descriptor;
}

/// The streams of the largest level; the second slice is empty unless the descriptor tells of one.
Result<Etc1sStreams> read_basis_lz(Bytes global_data, Bytes level, size_t levels, const Descriptor& descriptor) {
  ByteReader reader(global_data);
  Etc1sStreams streams;
  streams.endpoint_count = reader.u16();
  streams.selector_count = reader.u16();
  const size_t endpoints = reader.u32(), selectors = reader.u32(), tables = reader.u32();
  reader.u32();  // the length of data that ETC1S does not have
  const uint32_t flags = reader.u32();
  const Section colors = {reader.u32(), reader.u32()}, second = {reader.u32(), reader.u32()};
  constexpr size_t image_bytes = 20;
  reader.take((levels - 1) * image_bytes);
  streams.endpoints = reader.take(endpoints);
  streams.selectors = reader.take(selectors);
  streams.tables = reader.take(tables);
  if (!reader.ok()) return fail("KTX2", "damaged BasisLZ data");
  constexpr uint32_t is_difference = 2;
  if (flags & is_difference) return fail(ErrorKind::unsupported, "KTX2", "is a frame of a video");
  LW_TRY(color_bytes, bytes_of(level, colors));
  streams.colors = color_bytes;
  if (descriptor.samples == 1) return streams;
  LW_TRY(second_bytes, bytes_of(level, second));
  if (second_bytes.empty()) return fail("KTX2", "lacks the slice of its second channel");
  streams.second = second_bytes;
  streams.second_channel = descriptor.channels[1] == etc1s_aaa ? 3 : 1;
  return streams;
}

Result<Image> read_etc1s(Bytes file, const Header& header, Bytes level, const Descriptor& descriptor) {
  const auto [first, second] = descriptor.channels;
  const bool one = descriptor.samples == 1 && (first == etc1s_rgb || first == etc1s_rrr);
  const bool two = descriptor.samples == 2 &&
                   ((first == etc1s_rgb && second == etc1s_aaa) || (first == etc1s_rrr && second == etc1s_ggg));
  if (!one && !two) return fail(ErrorKind::unsupported, "KTX2", "ETC1S with channels that glTF does not have");
  if (header.supercompression != basis_lz) return fail(ErrorKind::unsupported, "KTX2", "ETC1S without BasisLZ");
  LW_TRY(global_data, bytes_of(file, header.global_data));
  LW_TRY(streams, read_basis_lz(global_data, level, header.levels, descriptor));
  return decode_etc1s(streams, static_cast<int>(header.width), static_cast<int>(header.height));
}

Result<Image> read_uastc(const Header& header, Bytes level, const Descriptor& descriptor) {
  const int width = static_cast<int>(header.width), height = static_cast<int>(header.height);
  const uint8_t channel = descriptor.channels[0];
  if (descriptor.samples != 1 ||
      (channel != uastc_rgb && channel != uastc_rgba && channel != uastc_rrr && channel != uastc_rg))
    return fail(ErrorKind::unsupported, "KTX2", "UASTC with channels that glTF does not have");
  const int channels = channel == uastc_rgba ? 4 : 3;
  if (header.supercompression == uncompressed) return decode_uastc(level, width, height, channels);
  if (header.supercompression != zstandard)
    return fail(ErrorKind::unsupported, "KTX2", "UASTC with a compression other than Zstandard");
  std::vector<uint8_t> blocks(texel_blocks(header.width) * texel_blocks(header.height) * uastc_block_bytes);
  if (header.level_uncompressed != blocks.size()) return fail("KTX2", "not as many UASTC blocks as its size");
  const size_t size = ZSTD_decompress(blocks.data(), blocks.size(), level.data(), level.size());
  if (ZSTD_isError(size) || size != blocks.size()) return fail("KTX2", "damaged Zstandard data");
  return decode_uastc(blocks, width, height, channels);
}

}  // namespace

bool is_ktx2(Bytes file) {
  return std::string_view(reinterpret_cast<const char*>(file.data()), file.size()).starts_with(identifier);
}

Result<Image> read_ktx2(Bytes file, ImageLimit limit) {
  LW_TRY(header, read_header(file));
  LW_CHECK(check_kind(header));
  LW_TRY(descriptor_bytes, bytes_of(file, header.descriptor));
  LW_TRY(descriptor, read_descriptor(descriptor_bytes));
  LW_CHECK(check_image_size(header.width, header.height, limit));
  if (uint64_t(header.width) * header.height > free_pixels + file.size() * pixels_per_byte)
    return fail("KTX2", "claims more pixels than it has bytes for");
  LW_TRY(level, bytes_of(file, header.level));
  switch (descriptor.model) {
    case etc1s: return read_etc1s(file, header, level, descriptor);
    case uastc: return read_uastc(header, level, descriptor);
  }
  return fail(ErrorKind::unsupported, "KTX2", "is not of Basis Universal");
}

}  // namespace lightwell
