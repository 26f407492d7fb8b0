// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/turned.h"

#include <algorithm>
#include <atomic>
#include <set>

#include "lightwell/bake/enclosed_lamps.h"
#include "lightwell/bake/mesh_name.h"
#include "lightwell/bake/mixed_winding.h"
#include "lightwell/bake/surface_pieces.h"
#include "lightwell/base/parallel.h"
#include "lightwell/mesh/winding.h"
#include "lightwell/trace/photons.h"

namespace lightwell {
namespace {

constexpr uint64_t photons = 1 << 16;
constexpr uint64_t photon_seed = 0x51de5;
/// Pieces that all threads together may count, 56 bytes each: beyond that fewer threads count.
constexpr size_t most_counts = 1 << 22;
/// Fewer hits on the back do not tell enough.
constexpr uint64_t least_hits = 100;
/// Of the photons that a back reflects: how many stay, of those behind the walls of a room. A sheet under a sky sends
/// most of them back to it.
constexpr double least_enclosed = 0.75;
/// Hits on the front for one on the back: of pieces that are turned, and of those that get two sides. A scan with holes
/// has eight and more.
constexpr double most_front = 0.02, most_front_of_both = 3;
/// A piece in which there is nothing but a lamp is a bulb, unless it is at least this share of all surfaces.
constexpr double least_area = 0.1;
/// What is around a lamp farther away, of the diagonal of the scene's focus, is the scene's own room and no cupboard in
/// it: a corner of the focus is half of that away at least.
constexpr float most_reach = 0.4f;

/// What the photons find out about a piece.
struct Sides {
  uint64_t front = 0, back = 0;
  uint64_t stay = 0, escape = 0;  // photons that its back has reflected
  uint64_t to_others = 0;         // of those that stay: to other pieces
  bool is_large = false;

  Sides& operator+=(const Sides& other) {
    front += other.front;
    back += other.back;
    stay += other.stay;
    escape += other.escape;
    to_others += other.to_others;
    return *this;
  }

  bool back_is_enclosed() const {
    return back >= least_hits && (to_others > 0 || is_large) &&
           static_cast<double>(stay) >= least_enclosed * static_cast<double>(stay + escape);
  }
  bool turned() const {
    return back_is_enclosed() && static_cast<double>(front) <= most_front * static_cast<double>(back);
  }
  bool lit_within(const PieceExtent& extent) const {
    return back_is_enclosed() && static_cast<double>(front) <= most_front_of_both * static_cast<double>(back) &&
           extent.nearly_closed() && extent.volume() > 0;
  }
};

bool has_one_side(const TraceScene& scene, uint32_t instance) {
  const Material& material = scene.material(instance);
  return !material.double_sided && max_component(material.emission) <= 0 && material.transmission <= 0;
}

/// The instances whose backs photons meet at all often. Few scenes have any, and the others need not be taken to
/// pieces.
std::vector<uint8_t> instances_met_from_behind(const World& world, int threads, Progress& progress) {
  std::vector<std::atomic<uint32_t>> backs(world.scene().instances.size());
  parallel_for(
      photons, 4096, threads,
      [&](size_t begin, size_t end, int) {
        for (size_t photon = begin; photon < end; photon++) {
          Flight flight;
          for (PhotonWalk walk(world, photon_seed, photon); walk.next(flight);)
            if (walk.end() && !walk.end()->front) backs[walk.end()->instance].fetch_add(1, std::memory_order_relaxed);
        }
      },
      [&] { return progress.cancelled(); });
  std::vector<uint8_t> met(backs.size());
  for (uint32_t i = 0; i < met.size(); i++) met[i] = backs[i] >= least_hits;
  return met;
}

std::vector<Sides> look_at_sides(const World& world, const SurfacePieces& pieces, int threads, Progress& progress) {
  const size_t wanted = static_cast<size_t>(threads > 0 ? threads : default_threads());
  const size_t count = std::min(wanted, std::max<size_t>(1, most_counts / (1 + pieces.count())));
  std::vector<std::vector<Sides>> seen(count, std::vector<Sides>(pieces.count()));
  parallel_for(
      photons, 4096, static_cast<int>(count),
      [&](size_t begin, size_t end, int thread) {
        std::vector<Sides>& sides = seen[static_cast<size_t>(thread)];
        for (size_t photon = begin; photon < end; photon++) {
          std::optional<size_t> left;  // the piece whose back reflected the photon
          Flight flight;
          for (PhotonWalk walk(world, photon_seed, photon); walk.next(flight);) {
            const auto met = walk.end() ? pieces.piece(*walk.end()) : std::nullopt;
            if (left && flight.from_back) {
              (walk.end() ? sides[*left].stay : sides[*left].escape)++;
              sides[*left].to_others += walk.end() && met != left;
            }
            left = met;
            if (left) (walk.end()->front ? sides[*left].front : sides[*left].back)++;
          }
        }
      },
      [&] { return progress.cancelled(); });
  double area = 0;
  for (size_t piece = 0; piece < pieces.count(); piece++) area += pieces.extent(piece).area;
  for (size_t piece = 0; piece < pieces.count(); piece++)
    seen[0][piece].is_large = pieces.extent(piece).area >= least_area * area;
  for (size_t thread = 1; thread < count; thread++)
    for (size_t piece = 0; piece < pieces.count(); piece++) seen[0][piece] += seen[thread][piece];
  return std::move(seen[0]);
}

std::string list_of(const std::set<std::string>& names) {
  constexpr size_t most_named = 5;
  std::string list;
  size_t named = 0;
  for (const std::string& name : names) {
    if (named == most_named) return list + " and " + std::to_string(names.size() - named) + " more";
    list += (named++ > 0 ? ", " : "") + name;
  }
  return list;
}

/// Turns a scene's pieces to where the light is.
class Turner {
 public:
  Turner(Scene& scene, const SurfacePieces& pieces, const std::vector<Sides>& sides)
      : scene_(scene), pieces_(pieces), sides_(sides) {}

  /// True when something was turned.
  bool turn() {
    for (size_t i = 0; i < scene_.primitives.size(); i++) {
      Primitive& primitive = scene_.primitives[i];
      if (turn_faces_of(i, primitive.mesh)) turned_.insert(name_of(primitive));
      bool both = false;
      pieces_.for_each_face(i, [&](size_t, size_t piece) { both = both || is_lit_within(piece); });
      if (both) {
        give_two_sides(primitive);
        two_sided_.insert(name_of(primitive));
      }
    }
    return !turned_.empty() || !two_sided_.empty();
  }

  /// `lamps`: those that were enclosed before anything was turned, but by all of the scene.
  void tell(Report& report, const std::vector<EnclosedLamp>& lamps) const {
    if (!turned_.empty())
      report.warn(list_of(turned_) + ": faces look away from the light on all sides; they are turned round");
    if (!two_sided_.empty())
      report.warn(list_of(two_sided_) + ": faces look outwards, but there is light inside; both sides are shown");
    for (const EnclosedLamp& enclosed : lamps) {
      const std::string mesh = name_of(scene_.primitives[enclosed.primitive]);
      if (turned_.contains(mesh) || two_sided_.contains(mesh))
        report.warn("lamp \"" + enclosed.lamp + "\" stands inside of " + mesh + ": its light stays within");
    }
  }

 private:
  bool is_lit_within(size_t piece) const {
    return !sides_[piece].turned() && sides_[piece].lit_within(pieces_.extent(piece));
  }

  bool turn_faces_of(size_t primitive, Mesh& mesh) {
    std::vector<uint8_t> wrong(mesh.faces.size());
    bool any = false;
    pieces_.for_each_face(primitive, [&](size_t face, size_t piece) {
      wrong[face] = sides_[piece].turned();
      any = any || wrong[face];
    });
    if (any) turn_faces(mesh, wrong);
    return any;
  }

  void give_two_sides(Primitive& primitive) {
    scene_.materials.push_back(scene_.material_of(primitive));
    scene_.materials.back().double_sided = true;
    primitive.material = static_cast<int>(scene_.materials.size()) - 1;
    if (primitive.source_mesh < 0) return;
    // Looked up anew each time: a new array at the root may move everything in it.
    const auto source = [&]() -> Json& {
      return scene_.document.json["meshes"][static_cast<size_t>(primitive.source_mesh)]["primitives"]
                                 [static_cast<size_t>(primitive.source_primitive)];
    };
    Json material = source().contains("material")
                        ? scene_.document.json["materials"][source()["material"].get<size_t>()]
                        : Json::object();
    material["doubleSided"] = true;
    const int index = DocumentBuilder(scene_.document).add("materials", std::move(material));
    source()["material"] = index;
  }

  std::string name_of(const Primitive& primitive) const { return mesh_name(scene_, primitive); }

  Scene& scene_;
  const SurfacePieces& pieces_;
  const std::vector<Sides>& sides_;
  std::set<std::string> turned_, two_sided_;
};

/// A viewer shades by the normals of vertices: they are to point where the faces do, which light has turned by now.
void turn_normals_to_faces(Scene& scene, Report& report) {
  std::set<std::string> names;
  for (Primitive& primitive : scene.primitives)
    if (turn_opposed_normals(primitive.mesh)) names.insert(mesh_name(scene, primitive));
  if (!names.empty()) report.warn(list_of(names) + ": normals point to the backs of the faces; they are turned round");
}

Result<std::unique_ptr<const World>> world_with_faces_turned(Scene& scene, int threads, Progress& progress,
                                                             Report& report) {
  LW_TRY(world, World::build(scene, threads));
  if (world->lights().dark()) return std::move(world);
  std::vector<uint8_t> met = instances_met_from_behind(*world, threads, progress);
  LW_TRY(mixed, unify_winding(scene, *world, met, threads, progress));
  if (!mixed.empty()) {
    report.warn(list_of(mixed) + ": some faces are wound against those beside them; they are turned round");
    LW_TRY(unified, World::build(scene, threads));
    world = std::move(unified);
    met = instances_met_from_behind(*world, threads, progress);
  }
  const SurfacePieces pieces(world->surfaces(), [&](uint32_t instance) {
    return met[instance] != 0 && has_one_side(world->surfaces(), instance);
  });
  if (pieces.count() == 0 && !progress.cancelled()) return std::move(world);
  const std::vector<Sides> sides = look_at_sides(*world, pieces, threads, progress);
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
  std::vector<EnclosedLamp> lamps = enclosed_lamps(*world);
  const float of_all = most_reach * length(world->surfaces().focus().size());
  std::erase_if(lamps, [&](const EnclosedLamp& lamp) { return lamp.reach > of_all; });
  Turner turner(scene, pieces, sides);
  // The world refers to the scene as it was: it must not be asked any more.
  if (!turner.turn()) return std::move(world);
  turner.tell(report, lamps);
  return World::build(scene, threads);
}

}  // namespace

Result<std::unique_ptr<const World>> world_facing_light(Scene& scene, int threads, Progress& progress, Report& report) {
  for (Primitive& primitive : scene.primitives)
    if (const size_t count = turn_faces_against_normals(primitive.mesh); count > 0)
      report.warn(mesh_name(scene, primitive) +
                  ": faces wound against the normals of their corners, turned round: " + std::to_string(count));
  LW_TRY(world, world_with_faces_turned(scene, threads, progress, report));
  turn_normals_to_faces(scene, report);
  return std::move(world);
}

}  // namespace lightwell
