// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/received_scene.h"

#include <algorithm>

#include "lightwell/asset/asset.h"
#include "lightwell/packing/restore_parts.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/texture/image_format.h"

namespace lightwell {
namespace {

float component(ByteReader& reader, const AttributeLayout& layout) {
  using Component = AttributeLayout::Component;
  const bool n = layout.normalized;
  switch (layout.component) {
    case Component::i8: return static_cast<float>(static_cast<int8_t>(reader.u8())) / (n ? 127.0f : 1.0f);
    case Component::u8: return static_cast<float>(reader.u8()) / (n ? 255.0f : 1.0f);
    case Component::i16: return static_cast<float>(static_cast<int16_t>(reader.u16())) / (n ? 32767.0f : 1.0f);
    case Component::u16: return static_cast<float>(reader.u16()) / (n ? 65535.0f : 1.0f);
    case Component::f32: return reader.f32();
  }
  return 0;
}

template <int N>
std::vector<Vec<float, N>> values_of(Bytes data, const AttributeLayout& layout, uint32_t count) {
  std::vector<Vec<float, N>> values(count);
  for (uint32_t i = 0; i < count; i++) {
    ByteReader reader(data.subspan(size_t(i) * layout.stride, layout.stride));
    for (int c = 0; c < std::min<int>(N, layout.components); c++) values[i][c] = component(reader, layout);
  }
  return values;
}

}  // namespace

void ReceivedScene::apply(const Update& update) {
  if (const auto* opening = std::get_if<OpeningUpdate>(&update)) {
    opening_.assign(opening->glb.begin(), opening->glb.end());
  } else if (const auto* mesh = std::get_if<MeshUpdate>(&update)) {
    take(*mesh);
  } else if (const auto* range = std::get_if<RangeUpdate>(&update)) {
    take(*range);
  } else if (const auto* draw = std::get_if<DrawUpdate>(&update)) {
    meshes_[draw->asset].vertices = draw->vertices;
    meshes_[draw->asset].faces.assign(draw->regions.begin(), draw->regions.end());
  } else if (const auto* texture = std::get_if<TextureUpdate>(&update)) {
    images_[texture->asset].assign(texture->file.begin(), texture->file.end());
  } else if (const auto* parts = std::get_if<PartsUpdate>(&update)) {
    parts_.assign(parts->file.begin(), parts->file.end());
    parts_inflated_ = parts->inflated;
  }
}

void ReceivedScene::take(const MeshUpdate& update) {
  Buffers& buffers = meshes_[update.asset];
  buffers.attributes = update.attributes;
  for (const AttributeLayout& layout : update.attributes)
    buffers.data.emplace_back(size_t(update.vertices) * layout.stride);
  buffers.indices.resize(size_t(update.faces) * 12);
}

void ReceivedScene::take(const RangeUpdate& update) {
  Buffers& buffers = meshes_[update.asset];
  auto& target = update.buffer == RangeUpdate::indices ? buffers.indices : buffers.data[update.buffer];
  std::copy(update.data.begin(), update.data.end(), target.begin() + static_cast<ptrdiff_t>(update.offset));
}

std::vector<Mesh> ReceivedScene::meshes_of(const Buffers& buffers, const std::map<uint32_t, uint32_t>& region_faces) {
  using Semantic = AttributeLayout::Semantic;
  Mesh mesh;
  for (size_t i = 0; i < buffers.attributes.size(); i++) {
    const AttributeLayout& layout = buffers.attributes[i];
    const Bytes data = buffers.data[i];
    switch (layout.semantic) {
      case Semantic::position: mesh.positions = values_of<3>(data, layout, buffers.vertices); break;
      case Semantic::normal: mesh.normals = values_of<3>(data, layout, buffers.vertices); break;
      case Semantic::texcoord_0: mesh.texcoords[0] = values_of<2>(data, layout, buffers.vertices); break;
      case Semantic::texcoord_1: mesh.texcoords[1] = values_of<2>(data, layout, buffers.vertices); break;
      case Semantic::color: mesh.colors = values_of<4>(data, layout, buffers.vertices); break;
    }
  }
  for (Vec3f& normal : mesh.normals) normal = normalized(normal);
  std::vector<Mesh> meshes;
  size_t first = 0;
  for (uint32_t region = 0; region < buffers.faces.size(); region++) {
    ByteReader reader(Bytes(buffers.indices).subspan(std::min(first, buffers.indices.size())));
    const auto all = region_faces.find(region);
    first += all == region_faces.end() ? 0 : size_t(12) * all->second;
    std::vector<Face> faces(buffers.faces[region]);
    for (Face& face : faces)
      for (uint32_t& corner : face) corner = reader.u32();
    meshes.push_back(buffers.faces.size() > 1 ? mesh_of_faces(mesh, faces) : mesh);
    if (buffers.faces.size() == 1) meshes.back().faces = std::move(faces);
  }
  return meshes;
}

Result<std::vector<uint8_t>> ReceivedScene::glb() const {
  if (opening_.empty()) return fail("", "the opening has not come");
  Report report;
  LW_TRY(document, read_document(opening_, {}, report));
  LW_TRY(primitives, read_refined_primitives(document.json));
  std::map<size_t, std::map<uint32_t, uint32_t>> region_faces;  // by stream
  for (const RefinedPrimitive& refined : primitives) region_faces[refined.stream][refined.region] = refined.faces;
  const PackRefinement refinement{[&](size_t stream) -> Result<std::vector<Mesh>> {
                                    const auto found = meshes_.find(asset_of_stream(static_cast<uint32_t>(stream)));
                                    if (found == meshes_.end()) return fail("", "a mesh has not come");
                                    return meshes_of(found->second, region_faces[stream]);
                                  },
                                  [this](size_t stream) -> Result<std::vector<uint8_t>> {
                                    const auto found = images_.find(asset_of_stream(static_cast<uint32_t>(stream)));
                                    return found == images_.end() ? std::vector<uint8_t>() : found->second;
                                  }};
  LW_TRY(parts, read_parts_description(document.json));
  LW_TRY(identity, read_identity(document.json));
  LW_CHECK(refine_document(document, refinement));
  if (parts && !parts_.empty()) {
    LW_TRY(file, read_parts_file(parts_, parts_inflated_));
    const auto final_level = [&](size_t primitive) {
      return read_primitive(document, static_cast<int>(parts->meshes), static_cast<int>(primitive), report);
    };
    LW_CHECK(restore_parts(document, *parts, std::move(file), final_level, identity.origin));
  }
  return write_glb(std::move(document), report);
}

}  // namespace lightwell
