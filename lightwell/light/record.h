// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "lightwell/base/bytes.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// Three numbers from 0 to 65408 in 32 bits (RGB9E5 of OpenGL's EXT_texture_shared_exponent): mantissas of 9 bits each
/// from the lowest bit on, then a shared exponent. Each is rounded to the nearest multiple of the largest one's step;
/// negative numbers and NaN become 0, larger ones 65408.
uint32_t encode_rgb9e5(const Vec3f& rgb);
Vec3f decode_rgb9e5(uint32_t bits);

/// (M_a + M_b) / 2, which |S_ab| never exceeds, of a pair of axes: xy, xz, yz.
Vec3f mixed_bound(const Moments& moments, size_t pair);

/// The record of one node, 33 bytes: six RGB9E5 for E (+x, -x, +y, -y, +z, -z) and nine signed bytes for S (red, green,
/// blue of xy, then xz, yz) in units of 1/127 of (M_a + M_b)/2, which S never exceeds. An invalid node has -128 in its
/// first signed byte, so the red S_xy of its fill is lost and reads as 0.
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

/// The nearest record to the moments of a node, which must be scaled so that E stays below 2^16: see light_scale.
MomentsRecord encode_record(const Moments& moments, bool valid);

/// The moments of a record, finite for any bits. Encoding them again gives back a record made by encode_record.
Moments decode_record(const MomentsRecord& record);

/// The power of two that brings the largest E of the grid into (2^9, 2^10], clamped to [2^-11, 2^15]. Records and the
/// GPU's half floats are multiplied by it. 1 for a dark grid.
float light_scale(const LightGrid& grid);

}  // namespace lightwell
