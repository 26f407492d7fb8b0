// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "lightwell/base/bytes.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// Three non-negative numbers below 65408 in 32 bits (RGB9E5 of OpenGL's EXT_texture_shared_exponent): 9 bits of
/// mantissa each from the lowest bit on, then a shared exponent. Each is rounded to the nearest multiple of the largest
/// one's step; what is negative or not a number becomes 0, what is too large the largest number.
uint32_t encode_rgb9e5(const Vec3f& rgb);
Vec3f decode_rgb9e5(uint32_t bits);

/// The record `moments` of one node: 33 bytes, six RGB9E5 for E (+x, -x, +y, -y, +z, -z) and nine signed bytes for S
/// (red, green, blue of xy, then xz, yz) in units of 1/127 of (M_a + M_b)/2, which S never exceeds. An invalid node has
/// -128 in its first signed byte, and 0 for the red S_xy of its fill.
struct MomentsRecord {
  std::array<uint32_t, 6> irradiance{};
  std::array<int8_t, 9> mixed{};

  static constexpr size_t bytes = 33;
  static constexpr int8_t invalid_mark = -128;

  bool valid() const { return mixed[0] != invalid_mark; }
  bool operator==(const MomentsRecord&) const = default;

  void write(ByteWriter& writer) const;
  static MomentsRecord read(ByteReader& reader);
};

/// The record nearest to the moments of a node. The moments are expected in a unit that keeps the grid's E below 2^16:
/// see light_scale.
MomentsRecord encode_record(const Moments& moments, bool valid);

/// The moments of a record. Any bits give finite moments; a decoded record encodes to itself.
Moments decode_record(const MomentsRecord& record);

/// The power of two that brings the largest E of the grid's nodes into (2^9, 2^10], within [2^-11, 2^15]: the unit of
/// records and of the GPU's half floats. 1 for a dark grid.
float light_scale(const LightGrid& grid);

}  // namespace lightwell
