// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "lightwell/base/bytes.h"

namespace lightwell {

/// The header byte of the vertex codec's version 1 in KHR_meshopt_compression, mode ATTRIBUTES.
constexpr uint8_t meshopt_vertices_v1 = 0xa1;

/// The fewest bytes in which version 1 can encode `count` elements: one control byte for every four byte columns of a
/// block of at most 256 elements.
double least_bytes_v1(size_t count, size_t stride);

/// Decodes version 1 (appendix A of the extension), which libmeshoptimizer 0.18 cannot: `count` elements of `stride`
/// bytes, a multiple of 4 up to 256. Returns nullopt for damaged data; safe for any bytes.
std::optional<std::vector<uint8_t>> decode_meshopt_vertices_v1(Bytes packed, size_t count, size_t stride);

}  // namespace lightwell
