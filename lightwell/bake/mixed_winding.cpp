// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/mixed_winding.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>

#include "lightwell/bake/mesh_name.h"
#include "lightwell/base/parallel.h"
#include "lightwell/mesh/connected_faces.h"
#include "lightwell/mesh/winding.h"
#include "lightwell/trace/photons.h"

namespace lightwell {
namespace {

constexpr uint64_t photons = 1 << 16;
constexpr uint64_t photon_seed = 0xface5;
/// Fewer hits on the wrong side do not tell enough; and so many times those on the right side they are at least.
constexpr uint32_t least_hits = 20;
constexpr uint32_t least_ratio = 8;

/// Photons that have met the faces of a connected piece: [wound against the rest][on the back].
using Hits = std::array<std::array<std::atomic<uint32_t>, 2>, 2>;

/// A primitive whose faces are not all wound alike.
struct Mixed {
  explicit Mixed(const Mesh& mesh, std::vector<uint8_t> of_faces)
      : against(std::move(of_faces)),
        pieces(connected_faces(mesh)),
        hits(pieces.empty() ? 0 : *std::ranges::max_element(pieces) + 1) {}

  /// Which faces are to be turned: those of one winding in a piece, if photons meet their backs and the other's fronts.
  bool wrong(size_t face) const {
    const Hits& found = hits[pieces[face]];
    const auto mostly_back = [&](size_t winding, size_t back) {
      return found[winding][back] >= least_hits && found[winding][back] >= least_ratio * found[winding][1 - back];
    };
    const size_t winding = against[face];
    return mostly_back(winding, 1) && mostly_back(1 - winding, 0);
  }

  std::vector<uint8_t> against;
  std::vector<uint32_t> pieces;
  mutable std::vector<Hits> hits;  // of each piece
};

using MixedPrimitives = std::map<int, Mixed>;

MixedPrimitives find_mixed(const Scene& scene, const std::vector<uint8_t>& met) {
  MixedPrimitives mixed;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const int number = scene.instances[i].primitive;
    const Primitive& primitive = scene.primitives[static_cast<size_t>(number)];
    if (!met[i] || mixed.contains(number) || max_component(scene.material_of(primitive).emission) > 0) continue;
    std::vector<uint8_t> against = wound_against_the_rest(primitive.mesh);
    if (std::ranges::find(against, 1) != against.end()) mixed.try_emplace(number, primitive.mesh, std::move(against));
  }
  return mixed;
}

void count_hits(const World& world, const MixedPrimitives& mixed, int threads, const Progress& progress) {
  const Scene& scene = world.scene();
  const auto count = [&](const Hit& hit) {
    const auto found = mixed.find(scene.instances[hit.instance].primitive);
    if (found == mixed.end()) return;
    const Mixed& of = found->second;
    of.hits[of.pieces[hit.face]][of.against[hit.face]][!hit.front].fetch_add(1, std::memory_order_relaxed);
  };
  parallel_for(
      photons, 4096, threads,
      [&](size_t begin, size_t end, int) {
        for (size_t photon = begin; photon < end; photon++) {
          Flight flight;
          for (PhotonWalk walk(world, photon_seed, photon); walk.next(flight);)
            if (walk.end()) count(*walk.end());
        }
      },
      [&] { return progress.cancelled(); });
}

/// Turns what is wrong; true when something was.
bool turn(Mesh& mesh, const Mixed& mixed) {
  std::vector<uint8_t> wrong(mesh.faces.size());
  for (size_t i = 0; i < wrong.size(); i++) wrong[i] = mixed.wrong(i);
  if (std::find(wrong.begin(), wrong.end(), 1) == wrong.end()) return false;
  turn_faces(mesh, wrong);
  return true;
}

}  // namespace

Result<std::set<std::string>> unify_winding(Scene& scene, const World& world, const std::vector<uint8_t>& met,
                                            int threads, Progress& progress) {
  std::set<std::string> names;
  const MixedPrimitives mixed = find_mixed(scene, met);
  if (mixed.empty()) return names;
  count_hits(world, mixed, threads, progress);
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
  for (const auto& [number, of] : mixed) {
    Primitive& primitive = scene.primitives[static_cast<size_t>(number)];
    if (turn(primitive.mesh, of)) names.insert(mesh_name(scene, primitive));
  }
  return names;
}

}  // namespace lightwell
