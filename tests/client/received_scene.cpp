// SPDX-License-Identifier: Apache-2.0
#include "tests/client/received_scene.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "lightwell/asset/asset.h"
#include "lightwell/base/assert.h"
#include "lightwell/light/atlas.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/light/stream.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/pack/opening.h"
#include "lightwell/pack/reader.h"
#include "lightwell/texture/stream.h"

namespace lightwell {
namespace {

std::vector<uint8_t> copy(Bytes bytes) { return {bytes.begin(), bytes.end()}; }

template <typename T>
void add_buffer(ReceivedScene::ReceivedMesh& mesh, std::span<const T> elements, uint32_t stride) {
  if (elements.empty()) return;
  mesh.buffers.push_back(copy({reinterpret_cast<const uint8_t*>(elements.data()), elements.size_bytes()}));
  mesh.strides.push_back(stride);
}

struct Apply {
  ReceivedScene& scene;

  std::string operator()(const OpeningUpdate& update) {
    if (!scene.opening.empty()) return "the opening came twice";
    scene.opening = copy(update.glb);
    return {};
  }
  std::string operator()(const MeshUpdate& update) {
    if (scene.opening.empty()) return "a mesh came before the opening";
    ReceivedScene::ReceivedMesh& mesh = scene.meshes[update.asset];
    for (const AttributeLayout& attribute : update.attributes) {
      mesh.buffers.emplace_back(size_t(update.vertices) * attribute.stride);
      mesh.strides.push_back(attribute.stride);
    }
    mesh.buffers.emplace_back(size_t(update.faces) * 12);
    mesh.strides.push_back(4);
    return {};
  }
  std::string operator()(const RangeUpdate& update) {
    ReceivedScene::ReceivedMesh& mesh = scene.meshes[update.asset];
    const size_t number = update.buffer == RangeUpdate::indices ? mesh.buffers.size() - 1 : update.buffer;
    if (number >= mesh.buffers.size()) return "a range of an unknown buffer";
    std::vector<uint8_t>& buffer = mesh.buffers[number];
    if (update.offset > buffer.size() || update.data.size() > buffer.size() - update.offset)
      return "a range beyond its buffer";
    if (update.offset % 4 != 0 || update.data.size() % 4 != 0) return "a range of odd length";
    std::ranges::copy(update.data, buffer.begin() + update.offset);
    if (update.buffer != RangeUpdate::indices) return {};
    return check_corners(mesh, update.offset / 4, (update.offset + update.data.size()) / 4);
  }
  std::string operator()(const DrawUpdate& update) {
    ReceivedScene::ReceivedMesh& mesh = scene.meshes[update.asset];
    if (update.faces < mesh.faces || update.vertices < mesh.vertices) return "a mesh has become coarser";
    const size_t drawn = mesh.faces;
    mesh.vertices = update.vertices;
    mesh.faces = update.faces;
    return check_corners(mesh, drawn * 3, size_t(mesh.faces) * 3);
  }
  std::string operator()(const LightUpdate& update) {
    if (update.atlas.size() != size_t(update.width) * update.height * update.depth * 8)
      return "an atlas of another size";
    if (update.nodes < 8) return "light without the opening's";
    scene.atlases[update.asset] = copy(update.atlas);
    return {};
  }
  std::string operator()(const TextureUpdate& update) {
    scene.textures[update.asset] = copy(update.file);
    return {};
  }
  std::string operator()(const PartsUpdate& update) {
    scene.textures[update.asset] = copy(update.file);
    return {};
  }
  std::string operator()(const CompleteUpdate&) {
    scene.complete = true;
    return {};
  }
  std::string operator()(const FailureUpdate& update) {
    scene.failure = update.message;
    scene.reason = update.reason;
    scene.kind = update.kind;
    return {};
  }

  /// At every moment the faces that are drawn refer to vertices that have come: none has all its coordinates zero in
  /// the sample.
  static std::string check_corners(const ReceivedScene::ReceivedMesh& mesh, size_t begin, size_t end) {
    const std::vector<uint8_t>& positions = mesh.buffers.front();
    for (size_t corner = begin; corner < std::min(end, size_t(mesh.faces) * 3); corner++) {
      uint32_t vertex;
      std::memcpy(&vertex, mesh.buffers.back().data() + corner * 4, 4);
      if (size_t(vertex) * 12 >= positions.size()) return "a face refers to no vertex";
      const auto position = Bytes(positions).subspan(size_t(vertex) * 12, 12);
      if (std::ranges::all_of(position, [](uint8_t byte) { return byte == 0; }))
        return "a face refers to a vertex that has not come";
    }
    return {};
  }
};

PackReader open_pack(Bytes pack) {
  const FetchBytes fetch = [pack](uint64_t first, uint64_t length) -> Result<std::vector<uint8_t>> {
    return copy(pack.subspan(static_cast<size_t>(first), static_cast<size_t>(length)));
  };
  return PackReader::open(fetch, pack.size()).value();
}

/// Decodes a whole stream, and calls between() after each block.
template <typename Decoder, typename Between>
void append_all(Decoder& decoder, const PackReader& reader, uint32_t stream, const Between& between) {
  for (uint32_t block = 0; block < reader.directory().streams[stream].blocks; block++) {
    const auto appended = decoder.append(reader.block(stream, block).value());
    LW_ASSERT(appended);
    between();
  }
}

template <typename Decoder>
void append_all(Decoder& decoder, const PackReader& reader, uint32_t stream) {
  append_all(decoder, reader, stream, [] {});
}

MeshDecoder open_mesh(const PackReader& reader, uint32_t stream) {
  const StreamEntry& entry = reader.directory().streams[stream];
  const auto [layout, places] = MeshParameters::read(entry.parameters, entry.codec == mesh_codec_regions).value();
  const BaseArrays base = BaseArrays::read(layout, places, glb_chunks(reader.opening()).bin).value();
  return std::move(MeshDecoder::open(layout, base.view(), entry.length).value());
}

ReceivedScene::ReceivedMesh decode_mesh(const PackReader& reader, uint32_t stream) {
  MeshDecoder decoder = open_mesh(reader, stream);
  append_all(decoder, reader, stream);
  ReceivedScene::ReceivedMesh mesh;
  add_buffer(mesh, decoder.positions(), 12);
  add_buffer(mesh, decoder.normals(), 8);
  add_buffer(mesh, decoder.texcoords(0), 8);
  add_buffer(mesh, decoder.texcoords(1), 8);
  add_buffer(mesh, decoder.colors(), 8);
  add_buffer(mesh, decoder.indices(), 4);
  mesh.vertices = decoder.layout().vertices;
  mesh.faces = decoder.layout().faces;
  return mesh;
}

std::vector<uint8_t> atlas_of(const LightDecoder& decoder, Fill fill) {
  const LightLayout& layout = decoder.layout();
  LightAtlas atlas(layout.shape, layout.normal_offset, layout.scale);
  LightGrid grid = decoder.grid();
  push_pull(grid, decoder.known(), fill);
  atlas.update(grid);
  return copy({reinterpret_cast<const uint8_t*>(atlas.halves().data()), atlas.halves().size_bytes()});
}

std::vector<uint8_t> decode_light(const PackReader& reader, uint32_t stream) {
  const StreamEntry& entry = reader.directory().streams[stream];
  LightDecoder decoder = LightDecoder::open(entry.parameters, entry.length).value();
  append_all(decoder, reader, stream);
  return atlas_of(decoder, Fill::none);
}

std::vector<uint8_t> decode_texture(const PackReader& reader, uint32_t stream) {
  std::vector<uint8_t> file;
  for (uint32_t block = 0; block < reader.directory().streams[stream].blocks; block++) {
    const std::vector<uint8_t> payload = reader.block(stream, block).value();
    file.insert(file.end(), payload.begin(), payload.end());
  }
  return file;
}

/// Whether the faces drawn are those of a level with as many, or (in the middle of a hand-over) each of its indices
/// that or one later level's.
bool shows_a_level(const ReceivedScene::ReceivedMesh& mesh, const std::vector<OnTheWay::Level>& levels) {
  if (mesh.faces == 0 && mesh.vertices == 0) return true;  // not handed over yet
  std::vector<uint32_t> shown(size_t(mesh.faces) * 3);
  std::memcpy(shown.data(), mesh.buffers.back().data(), shown.size() * sizeof(uint32_t));
  for (auto level = levels.begin(); level != levels.end(); level++) {
    if (level->vertices != mesh.vertices || level->indices.size() != shown.size()) continue;
    for (auto later = level; later != levels.end(); later++) {
      size_t i = 0;
      while (i < shown.size() && (shown[i] == level->indices[i] || shown[i] == later->indices[i])) i++;
      if (i == shown.size()) return true;
    }
  }
  return false;
}

}  // namespace

std::string ReceivedScene::apply(const Update& update) {
  if (complete || !failure.empty()) return "an update came after the end";
  return std::visit(Apply{*this}, update);
}

bool ReceivedScene::shows_only(const ReceivedScene& whole, const OnTheWay& way) const {
  if (!opening.empty() && opening != whole.opening) return false;
  for (const auto& [stream, mesh] : meshes) {
    const ReceivedMesh& full = whole.meshes.at(stream);
    for (size_t i = 0; i + 1 < mesh.buffers.size(); i++) {
      const size_t stride = mesh.strides[i];
      const auto at = [&](const auto& bytes, size_t v) { return bytes.subspan(v * stride, stride); };
      const std::vector<Normal16>& normals = way.normals.at(stream);
      const bool may_be_early = i == 1 && !normals.empty();
      for (size_t v = 0; v < mesh.vertices; v++) {
        if (std::ranges::equal(at(Bytes(mesh.buffers[i]), v), at(Bytes(full.buffers[i]), v))) continue;
        const Bytes early(reinterpret_cast<const uint8_t*>(normals.data()), normals.size() * sizeof(Normal16));
        if (!may_be_early || !std::ranges::equal(at(Bytes(mesh.buffers[i]), v), at(early, v))) return false;
      }
    }
    if (!shows_a_level(mesh, way.levels.at(stream))) return false;
  }
  return std::ranges::all_of(textures, [&](const auto& own) { return own.second == whole.textures.at(own.first); }) &&
         std::ranges::all_of(
             atlases, [&](const auto& own) { return std::ranges::find(way.atlases, own.second) != way.atlases.end(); });
}

ReceivedScene decode_directly(Bytes pack) {
  const PackReader reader = open_pack(pack);
  ReceivedScene scene;
  scene.opening = reader.opening();
  for (uint32_t stream = 0; stream < reader.directory().streams.size(); stream++) {
    switch (reader.directory().streams[stream].kind) {
      case StreamKind::mesh: scene.meshes[asset_of_stream(stream)] = decode_mesh(reader, stream); break;
      case StreamKind::light: scene.atlases[asset_of_stream(stream)] = decode_light(reader, stream); break;
      case StreamKind::texture: scene.textures[asset_of_stream(stream)] = decode_texture(reader, stream); break;
      case StreamKind::bricks:
      case StreamKind::parts: break;  // there are none
    }
  }
  scene.complete = true;
  return scene;
}

OnTheWay on_the_way(Bytes pack) {
  const PackReader reader = open_pack(pack);
  OnTheWay way;
  for (uint32_t stream = 0; stream < reader.directory().streams.size(); stream++) {
    const StreamEntry& entry = reader.directory().streams[stream];
    if (entry.kind == StreamKind::mesh) {
      MeshDecoder decoder = open_mesh(reader, stream);
      const auto add = [&] {
        way.levels[asset_of_stream(stream)].push_back(
            {decoder.vertices(), {decoder.indices().begin(), decoder.indices().end()}});
        std::vector<Normal16>& normals = way.normals[asset_of_stream(stream)];
        const auto now = decoder.normals();
        if (!now.empty())
          normals.insert(normals.end(), now.begin() + static_cast<ptrdiff_t>(normals.size()), now.end());
      };
      add();
      append_all(decoder, reader, stream, add);
    }
    if (entry.kind == StreamKind::light) {
      LightDecoder decoder = LightDecoder::open(entry.parameters, entry.length).value();
      const auto add = [&] {
        for (const Fill fill : {Fill::none, Fill::push_pull, Fill::push_pull_smooth})
          way.atlases.push_back(atlas_of(decoder, fill));
      };
      add();
      append_all(decoder, reader, stream, add);
    }
  }
  return way;
}

}  // namespace lightwell
