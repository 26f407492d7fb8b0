// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tsl/robin_map.h>

#include <memory>
#include <mutex>

#include "lightwell/base/random.h"
#include "lightwell/base/result.h"
#include "lightwell/scene/scene.h"
#include "lightwell/trace/coincident_faces.h"
#include "lightwell/trace/material.h"

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;
struct RTCFilterFunctionNArguments;
struct RTCRay;
struct RTCHit;

namespace lightwell {

/// A half-line from `origin` along a unit direction, up to `far` metres.
struct Ray {
  Vec3f origin{};
  Vec3f direction{};
  float far = std::numeric_limits<float>::infinity();
};

/// Where a ray meets a triangle.
struct Hit {
  Vec3f position{};
  Vec3f normal{};  ///< geometric, unit, of the front
  float distance = 0;
  uint32_t instance = 0;  ///< index into Scene::instances
  uint32_t face = 0;      ///< of the instance's mesh
  float u = 0, v = 0;     ///< weights of the face's second and third corner
  float cosine = 1;       ///< of the ray to the normal, positive
  bool front = true;      ///< the ray came from the front
  /// The tint of what the ray has passed on its way; also of a ray that meets nothing.
  Vec3f tint = Vec3f::filled(1);

  /// The normal on the side that the ray came from.
  Vec3f facing_normal() const { return front ? normal : -normal; }
};

/// A scene made ready for tracing rays with Embree. Threads may share it.
class TraceScene {
 public:
  /// Builds Embree's tree with `threads` threads, 0: all processors. The scene must outlive the result unchanged. Fails
  /// when there is no triangle to trace, when a mesh reaches beyond `farthest_position`, or when memory runs out.
  static Result<std::unique_ptr<const TraceScene>> build(const Scene& scene, int threads = 0);
  ~TraceScene();
  TraceScene(const TraceScene&) = delete;
  TraceScene& operator=(const TraceScene&) = delete;

  const Scene& scene() const { return scene_; }
  /// The bounding box of everything that is traced, metres.
  const Box3f& bounds() const { return bounds_; }
  /// The box of what the scene is about: see focus_of. Never empty, and within bounds() but for lamps.
  const Box3f& focus() const { return focus_; }

  /// Finds the nearest surface; false when there is none, and then only the hit's tint is set. Where a surface lets
  /// part of the light pass (alpha, transmission), chance decides whether the ray hits it: in scenes with such surfaces
  /// two numbers are drawn from `random`.
  bool intersect(const Ray& ray, Random& random, Hit& hit) const;
  /// The share of each colour that reaches the ray's end: 0 when something stops it, else the tint of what it passes.
  Vec3f transmittance(const Ray& ray, Random& random) const;

  /// The material at a hit.
  Surface surface(const Hit& hit) const { return surface(hit.instance, hit.face, hit.u, hit.v, hit.cosine); }
  /// The material at a point of a face, for a ray with this cosine to its normal; u and v are the weights of the face's
  /// second and third corner.
  Surface surface(uint32_t instance, uint32_t face, float u, float v, float cosine = 1) const {
    return surface(instance, face, u, v, cosine, scene_.images);
  }
  /// The same, textures but those that shine being blurred a little: see images_from_afar(), which are made when they
  /// are first asked for.
  Surface surface_from_afar(const Hit& hit) const;
  /// The material of an instance that is traced.
  const Material& material(uint32_t instance) const { return *placed_[instance].material; }
  const Mesh& mesh(uint32_t instance) const { return *placed_[instance].mesh; }
  /// False for primitives without faces.
  bool traced(uint32_t instance) const { return placed_[instance].mesh != nullptr; }

  /// True when the material is the same everywhere on the instance.
  bool is_uniform(uint32_t instance) const { return placed_[instance].uniform; }

  /// The radiance emitted back along the ray: by the front of a surface, by both sides when double-sided.
  Vec3f emission(const Hit& hit, const Surface& surface) const;
  /// The normal for shading, unit, on the side that a ray along `direction` came from: interpolated from the vertices,
  /// or the geometric one where the mesh has none, and turned by the normal map. For what paths look at; photons and
  /// baked light use the geometric normal (docs/decisions/022-materials.md).
  Vec3f shading_normal(const Hit& hit, const Vec3f& direction) const;

  /// The corners of a face in scene space, in the mesh's order.
  std::array<Vec3f, 3> corners(uint32_t instance, uint32_t face) const;
  /// The unit normal of a face's front, given its corners.
  Vec3f face_normal(uint32_t instance, const std::array<Vec3f, 3>& corners) const;

  /// The Embree scene, for measurements.
  RTCSceneTy* embree() const { return embree_; }

  /// The distance from a surface at which a ray starts so as not to hit it again, metres.
  float offset() const { return offset_; }
  /// The origin of a ray that leaves a surface at `position` on the side of `normal`.
  Vec3f leave(const Vec3f& position, const Vec3f& normal) const { return position + normal * offset_; }

 private:
  /// A traced instance.
  struct Placed {
    const Mesh* mesh = nullptr;
    const Material* material = nullptr;
    const float* scene_positions = nullptr;  // three floats a vertex; null when Embree places the instance
    bool mirrored = false;
    bool uniform = false;  // the material is the same everywhere, namely `surface`
    Surface surface;
  };
  struct Context;
  struct Placing;

  explicit TraceScene(const Scene& scene);
  Result<void> commit(int threads);
  Result<void> check_extent() const;
  void place(uint32_t instance, Placing& placing);
  RTCGeometryTy* new_geometry(Placed& placed, const Transform* to_scene, CoincidentFaces& others);
  void set_faces(RTCGeometryTy* geometry, const Placed& placed, const float* positions, CoincidentFaces& others);
  void turn_round(Hit& hit) const;
  RTCSceneTy* shared_scene(int primitive, Placed& placed);
  void mark_uniform(Placed& placed) const;
  Surface surface(uint32_t instance, uint32_t face, float u, float v, float cosine,
                  const std::vector<Image>& images) const;
  std::array<Vec2f, 2> texcoords(const Mesh& mesh, const Face& face, float u, float v) const;
  Vec3f mapped(const Hit& hit, const Vec3f& normal) const;
  Vec3f front_normal(uint32_t instance, const Vec3f& by_winding) const;
  uint64_t salt(Random& random) const;
  float cosine_of(const RTCRay& ray, const RTCHit& hit, uint32_t instance) const;
  static void filter(const RTCFilterFunctionNArguments* arguments);

  const Scene& scene_;
  RTCDeviceTy* device_ = nullptr;
  RTCSceneTy* embree_ = nullptr;
  std::vector<RTCSceneTy*> shared_;  // of each primitive; null unless Embree places its instances
  std::vector<int> uses_;            // instances of each primitive
  std::vector<Placed> placed_;       // of each instance
  Box3f bounds_, focus_;
  float offset_ = 0;
  bool lets_light_pass_ = false;
  tsl::robin_map<uint64_t, FaceNumber> turned_;  // of faces in one place that face opposite ways, each to the other
  mutable std::once_flag seen_from_afar_;
  mutable std::vector<Image> from_afar_;
};

}  // namespace lightwell
