// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/trace_scene.h"

#include <embree3/rtcore.h>

#include <set>

#include "lightwell/base/assert.h"
#include "lightwell/scene/finish_mesh.h"
#include "lightwell/trace/coincident_faces.h"
#include "lightwell/trace/focus.h"
#include "lightwell/trace/images_from_afar.h"
#include "lightwell/trace/normal_map.h"
#include "lightwell/trace/shading.h"
#include "lightwell/trace/texture_lookup.h"

namespace lightwell {
namespace {

/// A primitive whose copies for all of its instances have more faces than this is instanced by Embree: the extra level
/// of the tree slows rays down but keeps forests in memory.
constexpr size_t max_copied_faces = 1 << 20;

RTCRay embree_ray(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin[0];
  r.org_y = ray.origin[1];
  r.org_z = ray.origin[2];
  r.dir_x = ray.direction[0];
  r.dir_y = ray.direction[1];
  r.dir_z = ray.direction[2];
  r.tfar = ray.far;
  r.mask = ~0u;
  return r;
}

uint64_t key_of(const FaceNumber& number) { return uint64_t(number.instance) << 32 | number.face; }

template <typename T>
T interpolated(const std::vector<T>& values, const Face& face, float u, float v) {
  return values[face[0]] * (1 - u - v) + values[face[1]] * u + values[face[2]] * v;
}

}  // namespace

/// What has been placed so far, to leave out what lies exactly on it.
struct TraceScene::Placing {
  CoincidentFaces faces;
  std::set<std::pair<int, std::array<float, 12>>> instances;  // of those that Embree places
};

/// A ray's context: the salt by which chance decides which partly transparent surfaces it passes, and the tints of
/// those that it passed. Embree finds them in any order, also behind the one that stops the ray.
struct TraceScene::Context {
  struct Pane {
    float distance;
    std::array<float, 3> tint;
  };
  /// Of which a ray knows the tints; what further ones pass keeps its colour.
  static constexpr size_t most_panes = 16;

  RTCIntersectContext embree;  // first, so that Embree's pointer to it also points to this
  uint64_t salt = 0;
  std::array<Pane, most_panes> panes;  // the first pane_count: clearing all would cost most rays more than the others
  size_t pane_count = 0;

  /// Of the panes nearer than a distance.
  Vec3f tint(float distance) const {
    Vec3f product = Vec3f::filled(1);
    for (size_t i = 0; i < pane_count; i++)
      if (panes[i].distance < distance) product *= Vec3f{panes[i].tint};
    return product;
  }

  explicit Context(uint64_t ray_salt) : salt(ray_salt) { rtcInitIntersectContext(&embree); }
};

Result<std::unique_ptr<const TraceScene>> TraceScene::build(const Scene& scene, int threads) {
  std::unique_ptr<TraceScene> traced(new TraceScene(scene));
  LW_CHECK(traced->commit(threads));
  return traced;
}

TraceScene::TraceScene(const Scene& scene)
    : scene_(scene),
      shared_(scene.primitives.size()),
      uses_(scene.primitives.size()),
      placed_(scene.instances.size()) {}

TraceScene::~TraceScene() {
  for (RTCSceneTy* shared : shared_) {
    if (shared) rtcReleaseScene(shared);
  }
  if (embree_) rtcReleaseScene(embree_);
  if (device_) rtcReleaseDevice(device_);
}

Result<void> TraceScene::commit(int threads) {
  device_ = rtcNewDevice(threads > 0 ? ("threads=" + std::to_string(threads)).c_str() : nullptr);
  if (!device_)
    return fail(ErrorKind::limit, "Embree", "cannot start: too little memory, or too few threads, are left for it");
  embree_ = rtcNewScene(device_);
  rtcSetSceneFlags(embree_, RTC_SCENE_FLAG_ROBUST);
  for (const Instance& instance : scene_.instances) uses_[static_cast<size_t>(instance.primitive)]++;
  LW_CHECK(check_extent());
  {
    Placing placing;
    for (uint32_t i = 0; i < placed_.size(); i++) place(i, placing);
  }
  rtcCommitScene(embree_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
    // Releasing what Embree could not complete, such as its threads, ends the process.
    device_ = nullptr;
    embree_ = nullptr;
    shared_.clear();
    return fail(ErrorKind::limit, "Embree", "not enough memory for the scene's triangles");
  }

  RTCBounds box;
  rtcGetSceneBounds(embree_, &box);
  bounds_ = {{{box.lower_x, box.lower_y, box.lower_z}}, {{box.upper_x, box.upper_y, box.upper_z}}};
  if (bounds_.empty()) return fail("scene", "it has no triangles");
  focus_ = focus_of(*this);
  const float extent = max_component(focus_.size());
  const float farthest = max_component(max(-bounds_.lo, bounds_.hi));
  offset_ = std::max(1e-5f * extent, 0x1p-21f * farthest);
  return {};
}

/// Checks the distance of all meshes from the origin: beyond the limit, areas and powers would leave the range of a
/// float, and even farther out Embree silently drops triangles.
Result<void> TraceScene::check_extent() const {
  std::vector<Box3f> boxes;
  for (const Primitive& primitive : scene_.primitives) boxes.push_back(primitive.mesh.bounds());
  for (const Instance& instance : scene_.instances) {
    const Box3f& box = boxes[static_cast<size_t>(instance.primitive)];
    for (int corner = 0; corner < 8 && !box.empty(); corner++) {
      Vec3f p = box.lo;
      for (int axis = 0; axis < 3; axis++)
        if (corner >> axis & 1) p[axis] = box.hi[axis];
      const Vec3f placed = instance.to_scene.point(p);
      if (!(max_component(max(placed, -placed)) <= farthest_position))
        return fail(ErrorKind::limit, "node " + std::to_string(instance.node),
                    "its mesh reaches farther than 1e9 m from the origin");
    }
  }
  return {};
}

void TraceScene::place(uint32_t index, Placing& placing) {
  const Instance& instance = scene_.instances[index];
  const Primitive& primitive = scene_.primitives[static_cast<size_t>(instance.primitive)];
  if (primitive.mesh.faces.empty()) return;
  Placed& placed = placed_[index];
  placed.mesh = &primitive.mesh;
  placed.material = &scene_.material_of(primitive);
  placed.mirrored = instance.to_scene.determinant() < 0;
  mark_uniform(placed);
  lets_light_pass_ |= lets_light_pass(*placed.material);

  const size_t copies = static_cast<size_t>(uses_[static_cast<size_t>(instance.primitive)]);
  RTCGeometry geometry;
  if (copies == 1 || copies * primitive.mesh.faces.size() <= max_copied_faces) {
    geometry = new_geometry(placed, &instance.to_scene, placing.faces);
  } else {
    std::array<float, 12> columns;
    const Transform& t = instance.to_scene;
    const std::array<Vec3d, 4> axes{t.x, t.y, t.z, t.t};
    for (size_t i = 0; i < columns.size(); i++) columns[i] = static_cast<float>(axes[i / 3][static_cast<int>(i % 3)]);
    if (!placing.instances.emplace(instance.primitive, columns).second && !lets_light_pass(*placed.material)) return;
    geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, shared_scene(instance.primitive, placed));
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(geometry);
  }
  rtcAttachGeometryByID(embree_, geometry, index);
  rtcReleaseGeometry(geometry);
}

/// The triangles of an instance: in scene space with `to_scene`, otherwise in the primitive's own.
RTCGeometryTy* TraceScene::new_geometry(Placed& placed, const Transform* to_scene, CoincidentFaces& others) {
  const Mesh& mesh = *placed.mesh;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                sizeof(Vec3f), mesh.positions.size()));
  if (positions) {
    for (size_t i = 0; i < mesh.positions.size(); i++) {
      const Vec3f p = to_scene ? to_scene->point(mesh.positions[i]) : mesh.positions[i];
      for (size_t axis = 0; axis < 3; axis++) positions[3 * i + axis] = p.e[axis];
    }
    if (to_scene) placed.scene_positions = positions;
    set_faces(geometry, placed, positions, others);
  }
  if (lets_light_pass(*placed.material)) {
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryIntersectFilterFunction(geometry, filter);
    rtcSetGeometryOccludedFilterFunction(geometry, filter);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

/// Gives Embree the mesh's faces; those that others hide get corners that do not exist, whereupon it leaves them out.
void TraceScene::set_faces(RTCGeometryTy* geometry, const Placed& placed, const float* positions,
                           CoincidentFaces& others) {
  const std::vector<Face>& faces = placed.mesh->faces;
  const FaceLayer layer{.opaque = !lets_light_pass(*placed.material),
                        .shines = placed.material->emission != Vec3f{},
                        .mirrored = placed.mirrored};
  const auto corner = [&](uint32_t vertex) {
    const float* p = positions + 3 * size_t(vertex);
    return Vec3f{{p[0], p[1], p[2]}};
  };
  const auto instance = static_cast<uint32_t>(&placed - placed_.data());
  std::vector<uint32_t> hidden;
  for (uint32_t i = 0; i < faces.size(); i++) {
    const CoincidentFaces::Found found =
        others.add({instance, i}, {corner(faces[i][0]), corner(faces[i][1]), corner(faces[i][2])}, layer);
    if (found.hidden) hidden.push_back(i);
    if (found.turned && placed.scene_positions) {
      turned_[key_of({instance, i})] = *found.turned;
      turned_[key_of(*found.turned)] = {instance, i};
    }
  }
  if (hidden.empty()) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, faces.data(), 0, sizeof(Face),
                               faces.size());
    return;
  }
  auto* own = static_cast<Face*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Face), faces.size()));
  if (!own) return;
  std::ranges::copy(faces, own);
  for (const uint32_t i : hidden) own[i] = {~0u, ~0u, ~0u};
}

RTCSceneTy* TraceScene::shared_scene(int primitive, Placed& placed) {
  RTCSceneTy*& shared = shared_[static_cast<size_t>(primitive)];
  if (shared) return shared;
  shared = rtcNewScene(device_);
  rtcSetSceneFlags(shared, RTC_SCENE_FLAG_ROBUST);
  CoincidentFaces own;
  RTCGeometry geometry = new_geometry(placed, nullptr, own);
  rtcAttachGeometry(shared, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(shared);
  return shared;
}

void TraceScene::mark_uniform(Placed& placed) const {
  const Material& m = *placed.material;
  placed.uniform = placed.mesh->colors.empty() && !varies(m);
  if (placed.uniform) placed.surface = surface_of(m, scene_.images, {}, Vec4f::filled(1));
}

/// Draws two numbers in separate statements: within one expression the order would be unspecified.
uint64_t TraceScene::salt(Random& random) const {
  if (!lets_light_pass_) return 0;
  const uint64_t high = random.bits();
  return high << 32 | random.bits();
}

bool TraceScene::intersect(const Ray& ray, Random& random, Hit& hit) const {
  RTCRayHit r{};
  r.ray = embree_ray(ray);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  Context context(salt(random));
  rtcIntersect1(embree_, &context.embree, &r);
  hit.tint = context.tint(r.ray.tfar);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

  hit.instance = r.hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? r.hit.geomID : r.hit.instID[0];
  hit.face = r.hit.primID;
  hit.u = r.hit.u;
  hit.v = r.hit.v;
  hit.distance = r.ray.tfar;
  hit.position = ray.origin + ray.direction * hit.distance;
  hit.normal = front_normal(hit.instance, {{r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z}});
  if (dot(hit.normal, hit.normal) == 0) hit.normal = -ray.direction;  // a sliver without area
  const float cosine = -dot(hit.normal, ray.direction);
  hit.front = cosine > 0;
  hit.cosine = std::abs(cosine);
  if (!hit.front && !turned_.empty()) turn_round(hit);
  return true;
}

/// Where another face lies in the same place and turns its front to the ray, it is the one that is seen.
void TraceScene::turn_round(Hit& hit) const {
  const auto found = turned_.find(key_of({hit.instance, hit.face}));
  if (found == turned_.end()) return;
  const FaceNumber other = found->second;
  const std::array<Vec3f, 3> from = corners(hit.instance, hit.face), to = corners(other.instance, other.face);
  const std::array<float, 3> weights{1 - hit.u - hit.v, hit.u, hit.v};
  const auto weight_of = [&](const Vec3f& corner) {
    return weights[static_cast<size_t>(std::ranges::find(from, corner) - from.begin()) % 3];
  };
  hit.instance = other.instance;
  hit.face = other.face;
  hit.u = weight_of(to[1]);
  hit.v = weight_of(to[2]);
  hit.normal = -hit.normal;
  hit.front = true;
}

/// The unit normal of a face's front in scene space, given its normal by winding in the space in which Embree holds the
/// face.
Vec3f TraceScene::front_normal(uint32_t instance, const Vec3f& by_winding) const {
  const Placed& placed = placed_[instance];
  if (!placed.scene_positions) return scene_.instances[instance].to_scene.normal(normalized(by_winding));
  return normalized(placed.mirrored ? -by_winding : by_winding);
}

Vec3f TraceScene::transmittance(const Ray& ray, Random& random) const {
  RTCRay r = embree_ray(ray);
  Context context(salt(random));
  rtcOccluded1(embree_, &context.embree, &r);
  return r.tfar < 0 ? Vec3f{} : context.tint(ray.far);
}

/// The cosine in scene space of a ray to what it hits, both given in the space in which Embree holds the face.
float TraceScene::cosine_of(const RTCRay& ray, const RTCHit& hit, uint32_t instance) const {
  const Vec3f direction{{ray.dir_x, ray.dir_y, ray.dir_z}};
  const bool in_scene = placed_[instance].scene_positions;
  const Vec3f placed = in_scene ? direction : normalized(scene_.instances[instance].to_scene.vector(direction));
  return std::abs(dot(placed, front_normal(instance, {{hit.Ng_x, hit.Ng_y, hit.Ng_z}})));
}

/// Called by Embree for each hit of a partly transparent surface: rejects the hit by chance. The chance depends on ray
/// and face only, so that the order in which Embree finds hits does not matter.
void TraceScene::filter(const RTCFilterFunctionNArguments* arguments) {
  LW_ASSERT(arguments->N == 1);
  if (arguments->valid[0] == 0) return;
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  auto& context = *reinterpret_cast<Context*>(arguments->context);
  const auto& scene = *static_cast<const TraceScene*>(arguments->geometryUserPtr);
  const uint32_t instance = hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? hit.geomID : hit.instID[0];
  const uint64_t key = hash64(context.salt ^ hash64(uint64_t(instance) << 32 | hit.primID));
  const float chance = static_cast<float>(key >> 40) * 0x1p-24f;
  const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
  const Surface surface = scene.surface(instance, hit.primID, hit.u, hit.v, scene.cosine_of(ray, hit, instance));
  if (chance < surface.coverage) return;
  arguments->valid[0] = 0;
  if (!tints_light(scene.material(instance)) || context.pane_count == Context::most_panes) return;
  context.panes[context.pane_count++] = {ray.tfar, surface.tint.e};
}

std::array<Vec2f, 2> TraceScene::texcoords(const Mesh& mesh, const Face& face, float u, float v) const {
  std::array<Vec2f, 2> texcoords{};
  for (size_t set = 0; set < texcoords.size(); set++)
    if (!mesh.texcoords[set].empty()) texcoords[set] = interpolated(mesh.texcoords[set], face, u, v);
  return texcoords;
}

Surface TraceScene::surface_from_afar(const Hit& hit) const {
  if (material(hit.instance).emission_texture.image >= 0) return surface(hit);
  std::call_once(seen_from_afar_, [this] { from_afar_ = images_from_afar(scene_); });
  return surface(hit.instance, hit.face, hit.u, hit.v, hit.cosine, from_afar_);
}

Surface TraceScene::surface(uint32_t instance, uint32_t face, float u, float v, float cosine,
                            const std::vector<Image>& images) const {
  const Placed& placed = placed_[instance];
  if (placed.uniform) return placed.surface;
  const Mesh& mesh = *placed.mesh;
  const Face& f = mesh.faces[face];
  const Vec4f color = mesh.colors.empty() ? Vec4f::filled(1) : interpolated(mesh.colors, f, u, v);
  return surface_of(*placed.material, images, texcoords(mesh, f, u, v), color, cosine);
}

Vec3f TraceScene::emission(const Hit& hit, const Surface& surface) const {
  return hit.front || material(hit.instance).double_sided ? surface.emission : Vec3f{};
}

Vec3f TraceScene::shading_normal(const Hit& hit, const Vec3f& direction) const {
  const Placed& placed = placed_[hit.instance];
  const bool has_map = placed.material->normal_texture.image >= 0;
  if (placed.mesh->normals.empty() && !has_map) return hit.facing_normal();
  Vec3f normal = hit.normal;
  if (!placed.mesh->normals.empty()) {
    const Vec3f local = interpolated(placed.mesh->normals, placed.mesh->faces[hit.face], hit.u, hit.v);
    normal = scene_.instances[hit.instance].to_scene.normal(local);
    if (dot(normal, normal) == 0) normal = hit.normal;
  }
  const bool seen = dot(normal, hit.facing_normal()) >= 0;
  if (has_map) normal = mapped(hit, normal);
  return facing(seen ? normal : -normal, -direction);
}

/// The normal turned by the instance's normal map.
Vec3f TraceScene::mapped(const Hit& hit, const Vec3f& normal) const {
  const Mesh& mesh = this->mesh(hit.instance);
  const TextureLookup& map = material(hit.instance).normal_texture;
  const Face& face = mesh.faces[hit.face];
  const std::array<Vec2f, 3> at_corners{transformed(map, texcoords(mesh, face, 0, 0)),
                                        transformed(map, texcoords(mesh, face, 1, 0)),
                                        transformed(map, texcoords(mesh, face, 0, 1))};
  const Vec4f texel = look_up(map, scene_.images, texcoords(mesh, face, hit.u, hit.v), false);
  return mapped_normal(normal, corners(hit.instance, hit.face), at_corners, {{texel[0], texel[1], texel[2]}},
                       material(hit.instance).normal_scale);
}

std::array<Vec3f, 3> TraceScene::corners(uint32_t instance, uint32_t face) const {
  const Placed& placed = placed_[instance];
  const Face& f = placed.mesh->faces[face];
  std::array<Vec3f, 3> c;
  for (size_t i = 0; i < 3; i++) {
    if (placed.scene_positions) {
      const float* p = placed.scene_positions + 3 * size_t(f[i]);
      c[i] = {{p[0], p[1], p[2]}};
    } else {
      c[i] = scene_.instances[instance].to_scene.point(placed.mesh->positions[f[i]]);
    }
  }
  return c;
}

Vec3f TraceScene::face_normal(uint32_t instance, const std::array<Vec3f, 3>& c) const {
  const Vec3f normal = normalized(cross(c[1] - c[0], c[2] - c[0]));
  return placed_[instance].mirrored ? -normal : normal;
}

}  // namespace lightwell
