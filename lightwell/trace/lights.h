// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <span>

#include "lightwell/trace/environment.h"
#include "lightwell/trace/lit_texels.h"
#include "lightwell/trace/sampling.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// One source of light as a person would count them: a lamp of the scene, a connected piece of emissive surface, or the
/// environment.
struct Luminaire {
  enum class Kind { lamp, surface, environment };

  Kind kind = Kind::lamp;
  int index = -1;  ///< lamp: into Scene::lamps; surface: into Scene::instances
  Vec3f power{};   ///< W; of suns and the environment what enters the sphere round the scene
  // Of a surface:
  std::vector<uint32_t> faces{};  ///< of the instance's mesh
  Vec3f center{};                 ///< mean over the area
  float area = 0;                 ///< m2
  bool double_sided = false;
};

/// All light sources of a scene, for sampling.
class Lights {
 public:
  /// `scene` must outlive the lights; only its geometry is used here.
  explicit Lights(const TraceScene& scene);

  const std::vector<Luminaire>& luminaires() const { return luminaires_; }
  /// True when there is no light at all.
  bool dark() const { return choice_.total() <= 0; }
  /// What sources are chosen by, summed up, W: about the mean of power(), and not 0 unless dark.
  float total_weight() const { return static_cast<float>(choice_.total()); }
  /// False when the sum of all light is beyond a float.
  bool finite() const;
  /// Sum over all luminaires, W.
  Vec3f power() const;

  /// A photon as it leaves its source.
  struct Emission {
    Ray ray;       ///< far: where a lamp's range ends it (see emit)
    Vec3f flux{};  ///< W; its mean over many emissions is power()
    int luminaire = 0;
  };
  /// Emits a photon, sources being chosen by power. The range window of KHR_lights_punctual falls from 1 to 0 with the
  /// distance, so it is taken as the chance that a photon gets that far. Must not be dark.
  Emission emit(Random& random) const;

  /// Light that may arrive at a point from a source.
  struct Arrival {
    Vec3f direction{};   ///< unit, towards the source
    float distance = 0;  ///< to the source; infinite for suns and the environment
    Vec3f radiance{};    ///< W/m2/sr divided by density; for lamps without extent irradiance facing them / probability
    float density = 0;   ///< 1/sr; 0 for lamps without extent, which no other way of sampling finds
    int luminaire = 0;
  };
  /// Chooses a source by power and a point of it. Radiance 0 when the point is behind it. Must not be dark.
  Arrival sample(const Vec3f& point, Random& random) const;

  /// The density with which sample() at `point` chooses the direction to an emissive surface's `hit`.
  float density(const Vec3f& point, const Hit& hit) const;
  /// The luminaire that a hit belongs to; -1 when it does not shine.
  int luminaire(const Hit& hit) const;

  const EnvironmentLight& environment() const { return environment_; }
  /// The density with which sample() chooses a direction of the environment.
  float environment_density(const Vec3f& direction) const;
  /// Where photons carry all of the light: the scene's box, and when the environment shines some of the open air around
  /// it, so that a grid has nodes before the outsides of walls.
  const Box3f& region() const { return region_; }
  /// The environment's index among the luminaires; only when it is not black.
  int environment_luminaire() const { return elements_[static_cast<size_t>(environment_element_)].luminaire; }

 private:
  struct Triangle {
    Vec3f corner{}, edge_u{}, edge_v{}, normal{};
    float area = 0;

    Vec3f at(Vec2f uv) const { return corner + edge_u * uv[0] + edge_v * uv[1]; }
  };
  /// What the distribution chooses among: a lamp, a triangle that shines, or the environment.
  struct Element {
    int luminaire = 0;
    uint32_t instance = 0;  // of a triangle, as all that follows
    uint32_t face = 0;
    Triangle triangle{};
    bool double_sided = false;
  };

  void add_lamp(int index);
  void add_surface(uint32_t instance);
  void add_face(int luminaire, uint32_t instance, uint32_t face);
  void add_environment();
  void add(Element element, const Vec3f& power, float least_weight = 0);
  Triangle triangle(uint32_t instance, uint32_t face) const;
  Vec3f emission(const Element& element, Vec2f uv) const;
  Vec3f mean_emission(const Element& element) const;
  bool may_shine(const Element& element);
  Emission emit_from_lamp(const Lamp& lamp, Random& random) const;
  Emission emit_from_surface(const Element& element, Random& random) const;
  Emission emit_from_environment(Random& random) const;
  Ray ray_from_afar(const Vec3f& direction, Random& random) const;
  Arrival sample_lamp(const Lamp& lamp, const Vec3f& point) const;
  Arrival sample_surface(const Element& element, const Vec3f& point, Random& random) const;
  Arrival sample_environment(Random& random) const;

  const TraceScene& scene_;
  Box3f region_;
  Vec3f center_{};  // of the sphere round the region
  float radius_ = 0;
  std::vector<Luminaire> luminaires_;
  std::vector<Element> elements_;
  std::vector<float> weights_;
  std::map<int, LitTexels> lit_texels_;  // of emission textures, while lights are added
  Distribution choice_;
  std::vector<int> first_element_;  // of each instance, its faces follow one another; -1: does not shine
  EnvironmentLight environment_;
  int environment_element_ = -1;
};

}  // namespace lightwell
