// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/pose.h"

#include <cstring>

#include "lightwell/gltf/accessor.h"

namespace lightwell {
namespace {

/// How much each joint moves each vertex: four numbers of joints and their weights, as often as the file has them.
struct Influences {
  std::vector<std::vector<Vec4f>> joints, weights;
};

/// Adds a morph target's displacements of one attribute.
Result<void> displace(const Document& document, const Json& target, const char* semantic, double weight,
                      const std::string& name, size_t vertices, const std::vector<uint32_t>* only,
                      std::vector<Vec3f>& values) {
  const int accessor = index_of(target, semantic);
  if (accessor < 0) return {};
  auto displacements = read_sparse_vectors(document, accessor, vertices);
  if (!displacements) return fail(in_element(displacements.error(), name + "." + semantic));
  for (size_t i = 0; i < values.size(); i++) {
    const Vec3f moved = values[i] + (*displacements)[only ? (*only)[i] : i] * static_cast<float>(weight);
    if (is_finite(moved)) values[i] = moved;
  }
  return {};
}

Result<Influences> read_influences(const Document& document, const Json& primitive, const std::string& name,
                                   const std::vector<uint32_t>* only, size_t vertices) {
  Influences influences;
  const Json& attributes = member(primitive, "attributes");
  for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); set++) {
    for (const char* semantic : {"JOINTS_", "WEIGHTS_"}) {
      const std::string attribute = semantic + std::to_string(set);
      std::string place = name + ".attributes.";
      place += attribute;
      auto data = locate(document, index_of(attributes, attribute.c_str()));
      if (!data) return fail(in_element(data.error(), place));
      if (data->type.rows != 4 || data->type.columns != 1) return fail(place, "is of a type that it cannot have");
      auto& values = semantic[0] == 'J' ? influences.joints : influences.weights;
      values.push_back(read_vectors<4>(*data, only));
      if (values.back().size() != vertices) return fail(place, "has another count than POSITION");
    }
  }
  return influences;
}

/// The weighted mean of the joints that move a vertex.
Result<Transform> blend(const Influences& influences, size_t vertex, const std::vector<Transform>& joints,
                        const std::string& name) {
  Transform sum{{}, {}, {}, {}};
  double total = 0;
  const auto add = [&](const Transform& joint, double weight) {
    sum.x += joint.x * weight;
    sum.y += joint.y * weight;
    sum.z += joint.z * weight;
    sum.t += joint.t * weight;
    total += weight;
  };
  for (size_t set = 0; set < influences.joints.size(); set++)
    for (int k = 0; k < 4; k++) {
      const double weight = influences.weights[set][vertex][k], joint = influences.joints[set][vertex][k];
      if (!(weight > 0) || !std::isfinite(weight)) continue;
      if (!(joint >= 0 && joint < static_cast<double>(joints.size())))
        return fail(name, "a vertex names a joint that its skin does not have");
      add(joints[static_cast<size_t>(joint)], weight);
    }
  if (!(total > 0)) return joints.front();
  sum.x *= 1 / total;
  sum.y *= 1 / total;
  sum.z *= 1 / total;
  sum.t *= 1 / total;
  return sum;
}

Result<void> apply_skin(const Document& document, const Json& primitive, const std::string& name,
                        const std::vector<Transform>& joints, const std::vector<uint32_t>* only, Mesh& mesh) {
  LW_TRY(influences, read_influences(document, primitive, name, only, mesh.positions.size()));
  for (size_t i = 0; i < mesh.positions.size(); i++) {
    LW_TRY(joint, blend(influences, i, joints, name));
    mesh.positions[i] = joint.point(mesh.positions[i]);
    if (!is_finite(mesh.positions[i])) return fail(name, "its skin takes a vertex to no finite position");
    if (mesh.normals.empty()) continue;
    const Vec3f normal = joint.normal(mesh.normals[i]);
    if (is_finite(normal) && length(normal) > 0) mesh.normals[i] = normal;
  }
  return {};
}

}  // namespace

Result<void> apply_pose(const Document& document, const Json& primitive, const std::string& name, const Pose& pose,
                        size_t vertices, const std::vector<uint32_t>* only, Mesh& mesh) {
  const Json& targets = member(primitive, "targets");
  for (size_t i = 0; i < std::min(targets.size(), pose.weights.size()); i++) {
    const double weight = pose.weights[i];
    if (weight == 0 || !std::isfinite(weight)) continue;
    const std::string target = name + "." + element_name("targets", i);
    LW_CHECK(displace(document, targets[i], "POSITION", weight, target, vertices, only, mesh.positions));
    LW_CHECK(displace(document, targets[i], "NORMAL", weight, target, vertices, only, mesh.normals));
    for (Vec3f& normal : mesh.normals) normal = normalized(normal);
  }
  if (pose.joints.empty()) return {};
  return apply_skin(document, primitive, name, pose.joints, only, mesh);
}

Result<std::vector<Transform>> read_inverse_binds(const Document& document, int skin) {
  const Json& json = element(member(document.json, "skins"), static_cast<size_t>(skin));
  std::vector<Transform> matrices(member(json, "joints").size());
  const int accessor = index_of(json, "inverseBindMatrices");
  if (accessor < 0) return matrices;
  const std::string name = element_name("skins", static_cast<size_t>(skin)) + ".inverseBindMatrices";
  auto data = locate(document, accessor);
  if (!data) return fail(in_element(data.error(), name));
  if (data->type.component != Component::f32 || data->type.rows != 4 || data->type.columns != 4 ||
      data->count < matrices.size())
    return fail(name, "is of a type or count that it cannot have");
  for (size_t i = 0; i < matrices.size(); i++) {
    float m[16];
    std::memcpy(m, data->bytes.data() + i * data->stride, sizeof m);
    const auto column = [&](size_t first) { return Vec3f{{m[first], m[first + 1], m[first + 2]}}.cast<double>(); };
    matrices[i] = {column(0), column(4), column(8), column(12)};
    if (!is_finite(matrices[i].x + matrices[i].y + matrices[i].z + matrices[i].t))
      return fail(name, "holds numbers that are not finite");
  }
  return matrices;
}

}  // namespace lightwell
