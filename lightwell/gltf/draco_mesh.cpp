// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/draco_mesh.h"

#include <draco/compression/decode.h>

#include <algorithm>

#include "lightwell/gltf/draco_counts.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

/// The values of an attribute at all points, those that the file lacks being `filler`; empty without the attribute.
template <int N>
Result<std::vector<Vec<float, N>>> values_of(const draco::Mesh& mesh, draco::GeometryAttribute::Type type,
                                             float filler) {
  std::vector<Vec<float, N>> values;
  const draco::PointAttribute* attribute = mesh.GetNamedAttribute(type);
  if (!attribute) return values;
  const auto components = static_cast<int8_t>(std::min<int>(N, attribute->num_components()));
  values.resize(mesh.num_points(), Vec<float, N>::filled(filler));
  for (uint32_t i = 0; i < mesh.num_points(); i++) {
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(i));
    if (index.value() >= attribute->size() || !attribute->ConvertValue<float>(index, components, values[i].e.data()) ||
        !is_finite(values[i]))
      return fail("vertex " + std::to_string(i), "damaged Draco data");
  }
  return values;
}

/// What the values of an attribute are to be multiplied by to be shares of 1: whole numbers stand for shares of the
/// greatest one, whether the file says so or not.
float to_share(const draco::Mesh& mesh, draco::GeometryAttribute::Type type) {
  const draco::PointAttribute* attribute = mesh.GetNamedAttribute(type);
  if (!attribute || attribute->normalized()) return 1;
  switch (attribute->data_type()) {
    case draco::DT_UINT8: return 1 / 255.0f;
    case draco::DT_UINT16: return 1 / 65535.0f;
    default: return 1;
  }
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
  LW_TRY(positions, values_of<3>(*decoded, draco::GeometryAttribute::POSITION, 0));
  LW_TRY(normals, values_of<3>(*decoded, draco::GeometryAttribute::NORMAL, 0));
  LW_TRY(texcoords, values_of<2>(*decoded, draco::GeometryAttribute::TEX_COORD, 0));
  LW_TRY(colors, values_of<4>(*decoded, draco::GeometryAttribute::COLOR, 1));
  for (Vec2f& texcoord : texcoords) texcoord[1] = 1 - texcoord[1];
  const float share = to_share(*decoded, draco::GeometryAttribute::COLOR);
  const bool has_alpha = decoded->GetNamedAttribute(draco::GeometryAttribute::COLOR) != nullptr &&
                         decoded->GetNamedAttribute(draco::GeometryAttribute::COLOR)->num_components() > 3;
  for (Vec4f& color : colors) {
    for (int i = 0; i < 3; i++) color[i] = srgb_to_linear(std::clamp(color[i] * share, 0.0f, 1.0f));
    if (has_alpha) color[3] = std::clamp(color[3] * share, 0.0f, 1.0f);
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
