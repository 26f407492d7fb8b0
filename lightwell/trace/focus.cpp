// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/focus.h"

#include <algorithm>
#include <set>

#include "lightwell/trace/enclosure.h"

namespace lightwell {
namespace {

/// Of the scene's extent: a larger part is not worth being told apart.
constexpr float most_of_whole = 1.0f / 32;
/// Of the faces: what is left without surroundings, unless lamps or cameras tell what is meant; and what strays may
/// have.
constexpr double least_left = 0.5, most_strays = 0.05;
/// Of the rest's extent: how far away strays are.
constexpr float least_gap = 2;
constexpr int most_rounds = 16;
/// Faces are told apart up to about this number, with every instance, more of them in runs: a part takes 32 bytes.
constexpr size_t most_parts = 1 << 22;

/// Faces that lie in one box.
struct Part {
  Box3f box;
  double faces = 0;
};

float extent(const Box3f& box) { return max_component(box.size()); }

Box3f box_of(const std::vector<Part>& parts) {
  Box3f box;
  for (const Part& part : parts) box.extend(part.box);
  return box;
}

double faces_of(const std::vector<Part>& parts) {
  double faces = 0;
  for (const Part& part : parts) faces += part.faces;
  return faces;
}

/// The meshes right round lamps, small beside the whole, which stand for these lamps and not for what is lit.
std::set<uint32_t> bulbs_of(const TraceScene& scene) {
  std::set<uint32_t> bulbs;
  for (const Lamp& lamp : scene.scene().lamps) {
    if (lamp.kind == Lamp::Kind::sun) continue;
    const auto around = enclosure_of(scene, lamp.position);
    if (around && around->reach <= most_of_whole * extent(scene.bounds())) bulbs.insert(around->instance);
  }
  return bulbs;
}

std::vector<Part> parts_of(const TraceScene& scene) {
  const std::set<uint32_t> bulbs = bulbs_of(scene);
  const auto counts = [&](uint32_t instance) { return scene.traced(instance) && !bulbs.contains(instance); };
  const auto instances = static_cast<uint32_t>(scene.scene().instances.size());
  size_t all = 0;
  for (uint32_t i = 0; i < instances; i++)
    if (counts(i)) all += scene.mesh(i).faces.size();
  const size_t run = (all + most_parts - 1) / most_parts;
  std::vector<Part> parts;
  for (uint32_t i = 0; i < instances; i++) {
    if (!counts(i)) continue;
    const size_t faces = scene.mesh(i).faces.size();
    for (size_t face = 0; face < faces; face++) {
      if (face % run == 0) parts.emplace_back();
      for (const Vec3f& corner : scene.corners(i, static_cast<uint32_t>(face))) parts.back().box.extend(corner);
      parts.back().faces++;
    }
  }
  return parts;
}

/// Where lamps stand, but for suns, and cameras within a box.
Box3f stands_of(const Scene& scene, const Box3f& whole) {
  Box3f box;
  for (const Lamp& lamp : scene.lamps)
    if (lamp.kind != Lamp::Kind::sun) box.extend(lamp.position);
  for (const Camera& camera : scene.cameras) {
    const Vec3f eye = camera.to_scene.t.cast<float>();
    if (max(whole.lo, min(eye, whole.hi)) == eye) box.extend(eye);
  }
  return box;
}

/// Removes the largest parts if each of them is larger than all the others, with where lamps and cameras stand.
void remove_surroundings(std::vector<Part>& parts, const Box3f& stands) {
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return extent(a.box) < extent(b.box); });
  const float whole = extent(box_of(parts));
  const double all = faces_of(parts);
  Box3f rest = stands;
  double faces = 0;
  size_t kept = parts.size();
  for (size_t i = 0; i + 1 < parts.size(); i++) {
    rest.extend(parts[i].box);
    faces += parts[i].faces;
    const bool enough = faces > least_left * all || !stands.empty();
    if (enough && extent(rest) <= most_of_whole * whole && extent(parts[i + 1].box) >= extent(rest)) kept = i + 1;
  }
  parts.resize(kept);
}

/// Removes the parts on the smaller side of the widest gap on an axis if they are few and far away.
bool remove_strays(std::vector<Part>& parts, int axis) {
  std::stable_sort(parts.begin(), parts.end(),
                   [&](const Part& a, const Part& b) { return a.box.lo[axis] < b.box.lo[axis]; });
  float reached = parts.front().box.hi[axis], widest = 0;
  size_t after = 0;
  for (size_t i = 1; i < parts.size(); i++) {
    const float gap = parts[i].box.lo[axis] - reached;
    if (gap > widest) {
      widest = gap;
      after = i;
    }
    reached = std::max(reached, parts[i].box.hi[axis]);
  }
  if (after == 0) return false;
  std::vector<Part> left(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(after));
  std::vector<Part> right(parts.begin() + static_cast<std::ptrdiff_t>(after), parts.end());
  if (faces_of(left) < faces_of(right)) std::swap(left, right);
  if (faces_of(right) > most_strays * faces_of(parts) || widest < least_gap * extent(box_of(left))) return false;
  parts = std::move(left);
  return true;
}

}  // namespace

Box3f focus_of(const TraceScene& scene) {
  const Box3f whole = scene.bounds();
  std::vector<Part> parts = parts_of(scene);
  if (parts.empty()) return whole;
  const Box3f stands = stands_of(scene.scene(), whole);
  remove_surroundings(parts, stands);
  for (int round = 0; round < most_rounds; round++) {
    bool any = false;
    for (int axis = 0; axis < 3; axis++) any = remove_strays(parts, axis) || any;
    if (!any) break;
  }
  Box3f focus = box_of(parts);
  if (!stands.empty()) focus.extend(stands);
  return extent(focus) <= most_of_whole * extent(whole) ? focus : whole;
}

}  // namespace lightwell
