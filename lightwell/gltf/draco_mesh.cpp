// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/draco_mesh.h"

#include <draco/compression/decode.h>

#include <algorithm>

#include "lightwell/gltf/draco_counts.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

/// By what colours are multiplied to be fractions of one: files have whole numbers, marked as such or not.
float color_scale(const draco::Mesh& mesh) {
  const draco::PointAttribute* attribute = mesh.GetNamedAttribute(draco::GeometryAttribute::COLOR);
  if (!attribute || attribute->normalized()) return 1;
  if (attribute->data_type() == draco::DT_UINT8) return 1.0f / UINT8_MAX;
  return attribute->data_type() == draco::DT_UINT16 ? 1.0f / UINT16_MAX : 1;
}

/// The values of an attribute at all points, those that the file lacks being those of `filler`; empty without the
/// attribute.
template <int N>
Result<std::vector<Vec<float, N>>> values_of(const draco::Mesh& mesh, draco::GeometryAttribute::Type type,
                                             const Vec<float, N>& filler) {
  std::vector<Vec<float, N>> values;
  const draco::PointAttribute* attribute = mesh.GetNamedAttribute(type);
  if (!attribute) return values;
  const auto components = static_cast<int8_t>(std::min<int>(N, attribute->num_components()));
  values.resize(mesh.num_points(), filler);
  for (uint32_t i = 0; i < mesh.num_points(); i++) {
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(i));
    if (index.value() >= attribute->size() || !attribute->ConvertValue<float>(index, components, values[i].e.data()) ||
        !is_finite(values[i]))
      return fail("vertex " + std::to_string(i), "damaged Draco data");
  }
  return values;
}

}  // namespace

Result<std::shared_ptr<const draco::Mesh>> decode_draco(Bytes stream, const std::string& name) {
  LW_CHECK(check_draco_counts(stream, name));
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  try {
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) return fail(name, "damaged Draco data");
    return std::shared_ptr<const draco::Mesh>(std::move(mesh).value());
  } catch (const std::exception&) {
    return fail(name, "damaged Draco data");
  }
}

Result<Mesh> read_draco_file(Bytes file) {
  LW_TRY(decoded, decode_draco(file, ""));
  Mesh mesh;
  LW_TRY(positions, values_of<3>(*decoded, draco::GeometryAttribute::POSITION, {}));
  LW_TRY(normals, values_of<3>(*decoded, draco::GeometryAttribute::NORMAL, {}));
  LW_TRY(texcoords, values_of<2>(*decoded, draco::GeometryAttribute::TEX_COORD, {}));
  const float scale = color_scale(*decoded);
  const Vec4f opaque{{0, 0, 0, 1 / scale}};
  LW_TRY(colors, values_of<4>(*decoded, draco::GeometryAttribute::COLOR, opaque));
  for (Vec2f& texcoord : texcoords) texcoord[1] = 1 - texcoord[1];
  for (Vec4f& color : colors) {
    color = min(max(color * scale, Vec4f{}), Vec4f::filled(1));
    for (int i = 0; i < 3; i++) color[i] = srgb_to_linear(color[i]);
  }
  mesh.positions = std::move(positions);
  mesh.normals = std::move(normals);
  mesh.texcoords[0] = std::move(texcoords);
  mesh.colors = std::move(colors);
  for (uint32_t i = 0; i < decoded->num_faces(); i++) {
    const draco::Mesh::Face& face = decoded->face(draco::FaceIndex(i));
    mesh.faces.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  for (const Face& face : mesh.faces)
    for (const uint32_t corner : face)
      if (corner >= mesh.positions.size()) return fail("", "damaged Draco data");
  if (mesh.faces.empty()) return fail("", "has no triangles");
  return mesh;
}

}  // namespace lightwell
