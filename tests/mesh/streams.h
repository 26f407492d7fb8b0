// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "lightwell/mesh/progressive.h"
#include "lightwell/mesh/stream.h"
#include "tests/mesh/level.h"

namespace lightwell {

/// A mesh in order of refinement, and its stream.
struct Stream {
  ProgressiveMesh progressive;
  EncodedMesh encoded;
};

inline Stream stream_of(const Mesh& mesh, const SimplifyOptions& options, uint32_t block_vertices) {
  Progress silent;
  auto progressive = build_progressive(mesh, options, silent);
  EXPECT_TRUE(progressive);
  EncodedMesh encoded = encode(*progressive, block_vertices);
  return {std::move(*progressive), std::move(encoded)};
}

/// A decoder at the coarsest level.
inline MeshDecoder open(const EncodedMesh& encoded) {
  const OpenedBase base(encoded.base);
  auto decoder = MeshDecoder::open(encoded.layout, base.arrays(), stream_bytes(encoded));
  EXPECT_TRUE(decoder) << decoder.error().message();
  return std::move(*decoder);
}

}  // namespace lightwell
