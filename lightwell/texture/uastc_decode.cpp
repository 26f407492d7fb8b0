// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/uastc_decode.h"

#include <array>

#include "lightwell/base/assert.h"
#include "lightwell/texture/texel_block.h"

namespace lightwell {
namespace {

// The blocks are a selection of ASTC's, with the fields in another order, and hints for transcoders between, which a
// decoder passes over. Sections named "ASTC" are of the Khronos Data Format Specification's chapter on that format.

using Rgba = std::array<uint8_t, 4>;
using Texels = std::array<Rgba, 16>;

constexpr size_t most_subsets = 3;
constexpr size_t most_endpoint_values = 18;
constexpr size_t most_weights = 32;

struct Mode {
  uint8_t code, code_bits;  ///< a prefix code, its first bit the lowest
  uint8_t hint_bits;        ///< for transcoders, behind the code
  uint8_t subsets;          ///< parts of the block that have colours of their own
  uint8_t planes;           ///< weights of a texel: with two, one channel has its own
  uint8_t components;       ///< two are luminance and alpha, three are opaque
  uint8_t endpoint_bits;    ///< an endpoint has digit_base << endpoint_bits levels
  uint8_t digit_base;       ///< 3 for trits, 5 for quints, 1 for bits alone
  uint8_t weight_bits;
};

constexpr size_t partitioned_as_bc7_mode_2 = 7;  // by a table of its own
constexpr size_t solid_mode = 8;                 // one colour, and nothing else of what Mode says
constexpr size_t luminance_alpha_planes_mode = 17;
constexpr std::array<Mode, 19> modes = {{
    {0x01, 4, 15, 1, 1, 3, 6, 3, 4}, {0x35, 6, 15, 1, 1, 3, 8, 1, 2}, {0x1d, 5, 15, 2, 1, 3, 4, 1, 3},
    {0x03, 5, 15, 3, 1, 3, 2, 3, 2}, {0x13, 5, 15, 2, 1, 3, 3, 5, 2}, {0x0b, 5, 15, 1, 1, 3, 8, 1, 3},
    {0x1b, 5, 15, 1, 2, 3, 5, 5, 2}, {0x07, 5, 15, 2, 1, 3, 3, 5, 2}, {0x17, 5, 0, 1, 1, 4, 8, 1, 1},
    {0x0f, 5, 23, 2, 1, 4, 4, 1, 2}, {0x02, 3, 17, 1, 1, 4, 4, 3, 4}, {0x00, 2, 17, 1, 2, 4, 4, 3, 2},
    {0x06, 3, 17, 1, 1, 4, 6, 3, 3}, {0x1f, 5, 23, 1, 2, 4, 8, 1, 1}, {0x0d, 5, 23, 1, 1, 4, 8, 1, 2},
    {0x05, 7, 23, 1, 1, 2, 8, 1, 4}, {0x15, 6, 23, 2, 1, 2, 8, 1, 2}, {0x25, 6, 23, 1, 2, 2, 8, 1, 2},
    {0x09, 4, 15, 1, 1, 3, 5, 1, 5},
}};

/// The mode for each value of a block's seven lowest bits; modes.size() where no code begins so.
constexpr std::array<uint8_t, 128> mode_of_low_bits = [] {
  std::array<uint8_t, 128> table{};
  for (size_t low = 0; low < table.size(); low++) {
    table[low] = modes.size();
    for (size_t mode = 0; mode < modes.size(); mode++) {
      if ((low & ((size_t(1) << modes[mode].code_bits) - 1)) == modes[mode].code)
        table[low] = static_cast<uint8_t>(mode);
    }
  }
  return table;
}();

// The partitions that ASTC shares with BC7, texel 0 in the lowest bit: a set bit is a texel of subset 1. As these masks
// they are shorter than as the seeds of ASTC's partition function.
constexpr std::array<uint16_t, 30> masks_of_two = {0xcccc, 0x8888, 0x1111, 0xecc8, 0x377f, 0xfeec, 0x0137, 0x137f,
                                                   0xc800, 0x0013, 0xfe80, 0x17ff, 0x0017, 0x00ff, 0xfff0, 0x0fff,
                                                   0xff71, 0x8eff, 0x08ce, 0x008c, 0x7310, 0xceff, 0x7331, 0x088c,
                                                   0xceef, 0x6666, 0xf00f, 0x5555, 0x0f0f, 0x36c9};
constexpr std::array<uint16_t, 19> masks_of_bc7_mode_2 = {0x00f0, 0x4444, 0x0133, 0xcc80, 0xf0ff, 0x2222, 0xffc8,
                                                          0xccce, 0x3c03, 0x00ee, 0x7700, 0x3003, 0x00ce, 0xff80,
                                                          0x6fff, 0x1333, 0x11ff, 0x136c, 0x00ef};

struct MasksOfThree {
  uint16_t subset_1, subset_2;
};
constexpr std::array<MasksOfThree, 11> masks_of_three = {{{0x3300, 0xcc00},
                                                          {0x00ff, 0xf000},
                                                          {0x000f, 0xf000},
                                                          {0x000f, 0x00f0},
                                                          {0x3333, 0x4444},
                                                          {0x6666, 0x8888},
                                                          {0xcccc, 0x2222},
                                                          {0xee00, 0x1111},
                                                          {0x4444, 0x9999},
                                                          {0xf00f, 0x0f00},
                                                          {0x0cc0, 0xc00c}}};

/// The bits of a block from the lowest of its first byte on; zeros behind its end.
class BlockBits {
 public:
  explicit BlockBits(Bytes block) {
    ByteReader reader(block);
    low_ = reader.u64();
    high_ = reader.u64();
  }

  uint32_t low_seven() const { return low_ & 127; }
  /// The next bits; fewer than 32.
  uint32_t take(unsigned count) {
    if (count == 0) return 0;
    const uint64_t bits = low_ & ((uint64_t(1) << count) - 1);
    low_ = low_ >> count | high_ << (64 - count);
    high_ >>= count;
    return static_cast<uint32_t>(bits);
  }

 private:
  uint64_t low_, high_;
};

/// The subset of each of the 16 texels.
using Partition = std::array<uint8_t, 16>;

Partition partition_of(uint32_t subset_1, uint32_t subset_2) {
  Partition partition;
  for (size_t i = 0; i < partition.size(); i++)
    partition[i] = static_cast<uint8_t>((subset_1 >> i & 1) + 2 * (subset_2 >> i & 1));
  return partition;
}

/// False for a pattern that the tables do not have.
bool read_partition(BlockBits& bits, size_t mode, Partition& partition) {
  partition.fill(0);
  if (modes[mode].subsets == 1) return true;
  if (modes[mode].subsets == 3) {
    const size_t pattern = bits.take(4);
    if (pattern >= masks_of_three.size()) return false;
    partition = partition_of(masks_of_three[pattern].subset_1, masks_of_three[pattern].subset_2);
    return true;
  }
  const std::span<const uint16_t> masks =
      mode == partitioned_as_bc7_mode_2 ? std::span(masks_of_bc7_mode_2) : std::span<const uint16_t>(masks_of_two);
  const size_t pattern = bits.take(5);
  if (pattern >= masks.size()) return false;
  partition = partition_of(masks[pattern], 0);
  return true;
}

/// ASTC, "Endpoint Unquantization": a value in 0 to 255 for the lower bits of an endpoint and the trit or quint on top
/// of them. Names A, B, C and D are the specification's.
uint8_t unquantize_endpoint(const Mode& mode, uint32_t bits, uint32_t digit) {
  const unsigned count = mode.endpoint_bits;
  if (mode.digit_base == 1) return static_cast<uint8_t>(bits << (8 - count) | bits >> (2 * count - 8));
  const uint32_t a = bits & 1 ? 511 : 0, high = bits >> 1, d = digit;
  uint32_t b = 0, c = 0;
  switch (mode.digit_base << count) {
    case 12: b = high << 8 | high << 4 | high << 2 | high << 1, c = 93; break;
    case 40: b = high << 7 | high << 1 | high >> 1, c = 26; break;
    case 48: b = high << 6 | high, c = 22; break;
    case 160: b = high << 5 | high >> 3, c = 6; break;
    case 192: b = high << 4 | high >> 4, c = 5; break;
  }
  return static_cast<uint8_t>((a & 0x80) | ((d * c + b) ^ a) >> 2);
}

/// All endpoint values of a block. Unlike in ASTC the trits (five in up to eight bits) or quints (three in up to seven)
/// come first, and are digits of a plain number.
std::array<uint8_t, most_endpoint_values> read_endpoint_values(BlockBits& bits, const Mode& mode) {
  const size_t count = size_t(mode.subsets) * mode.components * 2;
  LW_ASSERT(count <= most_endpoint_values);
  std::array<uint8_t, most_endpoint_values> digits{}, values{};
  if (mode.digit_base > 1) {
    const size_t group = mode.digit_base == 3 ? 5 : 3, group_bits = mode.digit_base == 3 ? 8 : 7;
    for (size_t first = 0; first < count; first += group) {
      const size_t size = std::min(group, count - first);
      uint32_t number = bits.take(static_cast<unsigned>((size * group_bits + group - 1) / group));
      for (size_t i = 0; i < size; i++, number /= mode.digit_base)
        digits[first + i] = static_cast<uint8_t>(number % mode.digit_base);
    }
  }
  for (size_t i = 0; i < count; i++) values[i] = unquantize_endpoint(mode, bits.take(mode.endpoint_bits), digits[i]);
  return values;
}

/// The two colours between which the weights of a subset choose.
struct Endpoints {
  Rgba low, high;
};

/// ASTC, "Color Endpoint Decoding", the modes "luminance + alpha", RGB and RGBA, "direct" all of them; but colours are
/// never blue-contracted, in whatever order they stand.
std::array<Endpoints, most_subsets> read_endpoints(BlockBits& bits, const Mode& mode) {
  const auto values = read_endpoint_values(bits, mode);
  std::array<Endpoints, most_subsets> endpoints{};
  for (size_t subset = 0; subset < mode.subsets; subset++) {
    const uint8_t* pairs = &values[subset * mode.components * 2];
    for (size_t c = 0; c < 4; c++) {
      const bool luminance_alpha = mode.components == 2, opaque = mode.components == 3 && c == 3;
      const size_t pair = luminance_alpha ? c / 3 : c;
      endpoints[subset].low[c] = opaque ? 255 : pairs[2 * pair];
      endpoints[subset].high[c] = opaque ? 255 : pairs[2 * pair + 1];
    }
  }
  return endpoints;
}

/// ASTC, "Weight Unquantization": 0 to 64.
uint32_t unquantize_weight(uint32_t weight, unsigned bits) {
  const uint32_t six_bits =
      bits < 3 ? weight * (63 / ((1u << bits) - 1)) : weight << (6 - bits) | weight >> (2 * bits - 6);
  return six_bits + (six_bits > 32 ? 1 : 0);
}

/// The weights of all texels, one or two each. The first texel of a subset, its anchor, is stored without the highest
/// bit, which is zero.
std::array<uint8_t, most_weights> read_weights(BlockBits& bits, const Mode& mode, const Partition& partition) {
  std::array<uint8_t, most_weights> weights{};
  std::array<bool, most_subsets> anchored{};
  for (size_t texel = 0; texel < 16; texel++) {
    const unsigned stored_bits = mode.weight_bits - (anchored[partition[texel]] ? 0 : 1);
    anchored[partition[texel]] = true;
    for (size_t plane = 0; plane < mode.planes; plane++)
      weights[texel * mode.planes + plane] =
          static_cast<uint8_t>(unquantize_weight(bits.take(stored_bits), mode.weight_bits));
  }
  return weights;
}

/// ASTC, "Weight Application": in 16 bits, of which the upper eight are kept.
uint8_t interpolate(uint32_t low, uint32_t high, uint32_t weight) {
  return static_cast<uint8_t>((low * 257 * (64 - weight) + high * 257 * weight + 32) >> 6 >> 8);
}

/// False for a block that no encoder makes.
bool decode_block(Bytes block, Texels& texels) {
  BlockBits bits(block);
  const size_t mode_index = mode_of_low_bits[bits.low_seven()];
  if (mode_index == modes.size()) return false;
  const Mode& mode = modes[mode_index];
  bits.take(mode.code_bits);
  if (mode_index == solid_mode) {
    for (uint8_t& channel : texels[0]) channel = static_cast<uint8_t>(bits.take(8));
    texels.fill(texels[0]);
    return true;
  }
  bits.take(mode.hint_bits);
  Partition partition;
  if (!read_partition(bits, mode_index, partition)) return false;
  size_t second_plane = 4;  // the channel of its own weights; none
  if (mode.planes == 2) second_plane = mode_index == luminance_alpha_planes_mode ? 3 : bits.take(2);
  const auto endpoints = read_endpoints(bits, mode);
  const auto weights = read_weights(bits, mode, partition);
  for (size_t texel = 0; texel < texels.size(); texel++) {
    const Endpoints& colors = endpoints[partition[texel]];
    for (size_t c = 0; c < 4; c++)
      texels[texel][c] = interpolate(colors.low[c], colors.high[c],
                                     weights[texel * mode.planes + (mode.planes == 2 && c == second_plane ? 1 : 0)]);
  }
  return true;
}

}  // namespace

Result<Image> decode_uastc(Bytes blocks, int width, int height, int channels) {
  const size_t columns = texel_blocks(static_cast<size_t>(width)), rows = texel_blocks(static_cast<size_t>(height));
  if (blocks.size() != columns * rows * uastc_block_bytes) return fail("KTX2", "not as many UASTC blocks as its size");
  Image image{width, height, channels, {}};
  image.pixels.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
  Texels texels;
  for (size_t i = 0; i < columns * rows; i++) {
    if (!decode_block(blocks.subspan(i * uastc_block_bytes, uastc_block_bytes), texels))
      return fail("KTX2", "damaged UASTC block");
    put_texel_block(image, i % columns, i / columns,
                    [&](uint8_t* pixel, size_t texel) { std::copy_n(texels[texel].begin(), channels, pixel); });
  }
  return image;
}

}  // namespace lightwell
