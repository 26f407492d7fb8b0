// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/light/light_field.h"

namespace lightwell {

/// The light at the nodes of a regular grid, for programs that know nothing of bricks, validity and offsets
/// (docs/format.md, "The light for other programs"). A node is the centre of a cell: the box of all cells reaches half
/// a cell beyond the outermost nodes.
struct LightVolume {
  GridShape shape;
  Vec3d origin{};              ///< of the scene: what positions are counted from
  std::vector<Moments> nodes;  ///< shape.count()

  Vec3d center() const { return origin + ((shape.lo + shape.hi()) * 0.5f).cast<double>(); }
  Vec3f size() const { return shape.cell * shape.nodes.cast<float>(); }
};

/// Looks the light of a field up at the nodes of `shape`: a node inside of a solid gets that of the free nodes around.
LightVolume sample_volume(const LightField& field, const GridShape& shape, const Vec3d& origin);

/// A file for three.js: LightProbeGrid as JSON, in the form of its pull request 33658, with nodes where three.js 0.187
/// has them. Nine spherical harmonics a colour, which give the moments' irradiance exactly, in 4096ths.
std::string three_light_probe_grid(const LightVolume& volume);

/// A file for Bevy: the 3D texture of an IrradianceVolume as KTX2, half floats. Its Transform is the volume's centre
/// and size. A texel is what a white surface that faces its axis direction reflects, in W/m²/sr.
std::vector<uint8_t> bevy_irradiance_volume(const LightVolume& volume);

}  // namespace lightwell
