// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/luminaire_inventory.h"

#include <map>
#include <tuple>

#include "lightwell/mesh/connected_faces.h"
#include "lightwell/trace/lit_texels.h"
#include "lightwell/trace/punctual_light.h"

namespace lightwell {
namespace {

class Inventory {
 public:
  Inventory(const TraceScene& scene, const EnvironmentLight& environment, const LightRegion& region)
      : scene_(scene), environment_(environment), region_(region) {
    result_.first_element.assign(scene.scene().instances.size(), -1);
  }

  LuminaireInventory take() {
    for (size_t i = 0; i < scene_.scene().lamps.size(); i++) add_lamp(static_cast<int>(i));
    for (uint32_t i = 0; i < result_.first_element.size(); i++) {
      const int copy = copies_[copy_key(i)]++;
      if (scene_.traced(i) && max_component(scene_.material(i).emission) > 0) add_surface(i, copy);
    }
    if (!environment_.black()) add_environment();
    return std::move(result_);
  }

 private:
  /// Instances with the same key are copies placed by one node.
  std::tuple<int, int> copy_key(uint32_t instance) const {
    const Instance& placed = scene_.scene().instances[instance];
    return {placed.node, placed.primitive};
  }

  int add_luminaire(const LuminaireId& id, int index) {
    result_.luminaires.push_back({.id = id, .index = index});
    return static_cast<int>(result_.luminaires.size()) - 1;
  }

  void add_element(int luminaire, const Vec3f& power, float least_weight = 0) {
    result_.elements.push_back({luminaire, std::max(mean_of_channels(power), least_weight)});
    result_.luminaires[static_cast<size_t>(luminaire)].power += power;
  }

  void add_lamp(int index) {
    const Lamp& lamp = scene_.scene().lamps[static_cast<size_t>(index)];
    add_element(add_luminaire({.kind = LuminaireId::Kind::lamp, .node = lamp.node}, index),
                punctual_power(lamp, region_));
  }

  void add_surface(uint32_t instance, int copy) {
    const Instance& placed = scene_.scene().instances[instance];
    const Primitive& primitive = scene_.scene().primitives[static_cast<size_t>(placed.primitive)];
    const LuminaireId id{.kind = LuminaireId::Kind::surface,
                         .node = placed.node,
                         .copy = copy,
                         .primitive = primitive.source_primitive,
                         .vertex = ~0u};
    const std::vector<uint32_t> pieces = connected_faces(scene_.mesh(instance));
    const size_t first = result_.luminaires.size();
    result_.first_element[instance] = static_cast<int>(result_.elements.size());
    for (uint32_t face = 0; face < pieces.size(); face++) {
      const size_t luminaire = first + pieces[face];
      if (luminaire == result_.luminaires.size()) add_luminaire(id, static_cast<int>(instance));
      add_face(static_cast<int>(luminaire), instance, face);
    }
    for (size_t i = first; i < result_.luminaires.size(); i++) {
      Luminaire& piece = result_.luminaires[i];
      if (piece.area > 0) piece.center *= 1 / piece.area;
    }
  }

  /// Adds a face to its piece of surface, whose center is not yet divided by its area.
  void add_face(int luminaire, uint32_t instance, uint32_t face) {
    const EmissiveFace& shining = result_.faces.emplace_back(scene_, instance, face);
    Luminaire& piece = result_.luminaires[static_cast<size_t>(luminaire)];
    piece.double_sided = scene_.material(instance).double_sided;
    piece.faces.push_back(face);
    for (const uint32_t vertex : scene_.mesh(instance).faces[face]) piece.id.vertex = std::min(piece.id.vertex, vertex);
    piece.center += shining.center() * shining.area();
    piece.area += shining.area();
    if (!may_shine(instance, face)) return add_element(luminaire, {});
    add_element(luminaire, shining.mean_emission(scene_) * shining.spread(), shining.least_weight(scene_));
  }

  /// False only if the emission texture is black all over the face.
  bool may_shine(uint32_t instance, uint32_t face) {
    const TextureLookup& texture = scene_.material(instance).emission_texture;
    if (texture.image < 0) return true;
    const Mesh& mesh = scene_.mesh(instance);
    const std::vector<Vec2f>& texcoords = mesh.texcoords[texture.texcoord == 1 ? 1 : 0];
    std::array<Vec2f, 3> of_corners{};
    for (size_t i = 0; i < 3 && !texcoords.empty(); i++) of_corners[i] = texcoords[mesh.faces[face][i]];
    const auto image = static_cast<size_t>(texture.image);
    return lit_texels_.try_emplace(texture.image, scene_.scene().images[image]).first->second.any(texture, of_corners);
  }

  void add_environment() {
    result_.environment_luminaire = add_luminaire({.kind = LuminaireId::Kind::environment}, -1);
    const float sphere_area = 4 * region_.beam_area();
    add_element(result_.environment_luminaire, environment_.mean() * (pi * sphere_area));
  }

  const TraceScene& scene_;
  const EnvironmentLight& environment_;
  const LightRegion& region_;
  std::map<std::tuple<int, int>, int> copies_;
  std::map<int, LitTexels> lit_texels_;  // of emission textures, by image
  LuminaireInventory result_;
};

}  // namespace

LuminaireInventory take_inventory(const TraceScene& scene, const EnvironmentLight& environment,
                                  const LightRegion& region) {
  return Inventory(scene, environment, region).take();
}

LuminaireInventory restricted_to(const LuminaireSet& shining, LuminaireInventory inventory) {
  for (size_t i = 0; i < inventory.luminaires.size(); i++)
    if (!shining.contains(static_cast<int>(i))) inventory.luminaires[i].power = {};
  if (!shining.contains(inventory.environment_luminaire) && inventory.environment_luminaire >= 0) {
    inventory.elements.pop_back();
    inventory.environment_luminaire = -1;
  }
  for (LuminaireInventory::Element& element : inventory.elements)
    if (!shining.contains(element.luminaire)) element = {.luminaire = -1, .weight = 0};
  return inventory;
}

}  // namespace lightwell
