// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <numbers>

#include "lightwell/base/bytes.h"
#include "lightwell/base/half.h"
#include "lightwell/packing/light_volume.h"

namespace lightwell {
namespace {

// KTX 2.0, https://registry.khronos.org/KTX/specs/2.0/ktxspec.v2.html: header and index, level index, data format
// descriptor, key and value, level.
constexpr std::array<uint8_t, 12> identifier = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
constexpr uint32_t r16g16b16a16_sfloat = 97;  // VkFormat
constexpr uint32_t header_bytes = 80, level_index_bytes = 24;
constexpr uint32_t texel_bytes = 8;

// Four half floats a texel (Khronos Data Format Specification 1.3, section 5).
std::vector<uint8_t> format_descriptor() {
  constexpr uint32_t channels = 4, block_bytes = 24 + 16 * channels;
  constexpr std::array<uint8_t, 4> red_green_blue_alpha = {0, 1, 2, 15};
  constexpr uint8_t is_signed_float = 0xc0;
  ByteWriter out;
  out.u32(4 + block_bytes);
  out.u32(0);  // of Khronos, basic
  out.u16(2);  // version 1.3
  out.u16(block_bytes);
  for (const uint8_t value : {1, 1, 1, 0}) out.u8(value);  // RGBSDA, primaries of BT.709, linear, alpha is straight
  out.u32(0);                                              // texel blocks of one texel
  out.u32(texel_bytes);
  out.u32(0);
  for (uint16_t channel = 0; channel < channels; channel++) {
    out.u16(static_cast<uint16_t>(16 * channel));
    out.u8(15);  // bits less 1
    out.u8(red_green_blue_alpha[channel] | is_signed_float);
    out.u32(0);  // position within the block
    out.f32(-1);
    out.f32(1);
  }
  return out.release();
}

std::vector<uint8_t> key_and_value() {
  constexpr std::string_view key = "KTXwriter", value = "Lightwell " LIGHTWELL_VERSION;
  ByteWriter out;
  out.u32(static_cast<uint32_t>(key.size() + 1 + value.size() + 1));
  out.append(as_bytes(key));
  out.u8(0);
  out.append(as_bytes(value));
  out.u8(0);
  out.align(4);
  return out.release();
}

// Texels of (x, 2 y, 3 z) nodes: along z the grid for the axes x, y, z, of each along y the positive direction, then
// the negative one. So Bevy's shader reads them; the text of its documentation has the signs the other way round.
std::vector<uint8_t> texels(const LightVolume& volume) {
  const Vec3i nodes = volume.shape.nodes;
  ByteWriter out;
  for (size_t axis = 0; axis < 3; axis++)
    for (int z = 0; z < nodes[2]; z++)
      for (size_t negative = 0; negative < 2; negative++)
        for (int y = 0; y < nodes[1]; y++)
          for (int x = 0; x < nodes[0]; x++) {
            const Vec3f& light = volume.nodes[volume.shape.index({{x, y, z}})].m[2 * axis + negative];
            for (const float channel : light.e) out.u16(to_half(channel * std::numbers::inv_pi_v<float>));
            out.u16(to_half(1));
          }
  return out.release();
}

}  // namespace

std::vector<uint8_t> bevy_irradiance_volume(const LightVolume& volume) {
  const std::vector<uint8_t> descriptor = format_descriptor(), pairs = key_and_value(), level = texels(volume);
  const auto length = [](const std::vector<uint8_t>& bytes) { return static_cast<uint32_t>(bytes.size()); };
  const uint32_t descriptor_at = header_bytes + level_index_bytes, pairs_at = descriptor_at + length(descriptor);
  const uint32_t level_at = (pairs_at + length(pairs) + texel_bytes - 1) / texel_bytes * texel_bytes;
  ByteWriter out;
  out.append(identifier);
  out.u32(r16g16b16a16_sfloat);
  out.u32(2);  // bytes of a number
  for (int axis = 0; axis < 3; axis++) out.u32(static_cast<uint32_t>(volume.shape.nodes[axis] * (axis + 1)));
  for (const uint32_t value : {0, 1, 1, 0}) out.u32(value);  // no array, one face, one level, not compressed further
  for (const uint32_t value : {descriptor_at, length(descriptor), pairs_at, length(pairs)}) out.u32(value);
  out.u64(0);  // no global data of a compression
  out.u64(0);
  for (const uint64_t value : {uint64_t(level_at), uint64_t(level.size()), uint64_t(level.size())}) out.u64(value);
  out.append(descriptor);
  out.append(pairs);
  out.align(texel_bytes);
  out.append(level);
  return out.release();
}

}  // namespace lightwell
