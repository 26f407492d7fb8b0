// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/scene/client_lamp.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// What of a scene goes into one mesh a material in the pack.
struct MergeableParts {
  std::vector<bool> meshes;  ///< of the document: all their primitives do
  std::vector<bool> nodes;   ///< of the document: hold nothing but such meshes, so that the opening need not have them
  /// Of each material the first one that is the same; of very many, that differs in its name and extras alone, since
  /// there are exporters that make one for each part.
  std::vector<int> alike;
};

/// The parts that stay as the file has them together, whatever is done with a pack: static, without extensions, shown
/// by the default scene alone, not blended (those are drawn from the farthest to the nearest), no lamp's own surface,
/// not so small beside all of its kind that the lattice they share would change its form. Of scenes of few parts none,
/// since the opening can name them all; nor where nearly each is of a kind of its own; nor what has vertices enough to
/// be worth a stream of its own, or is shown so often that its copies would take more bytes than that and its nodes.
MergeableParts mergeable_parts(const Scene& scene, std::span<const ClientLamp> lamps);

/// The attributes that a mesh has, a bit for each.
unsigned attributes_of(const Mesh& mesh);

/// What primitives need in common to be merged: material and attributes.
using PartKind = std::pair<int, unsigned>;
PartKind kind_of(const Primitive& primitive, const std::vector<int>& alike);

}  // namespace lightwell
