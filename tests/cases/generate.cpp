// SPDX-License-Identifier: Apache-2.0
#include "tests/cases/generate.h"

#include "lightwell/base/file_blocks.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/mesh/progressive.h"
#include "lightwell/texture/stream.h"
#include "tests/asset/asset_case.h"
#include "tests/client/sample_pack.h"
#include "tests/light/brick_fields.h"
#include "tests/mesh/level.h"
#include "tests/mesh/shapes.h"
#include "tests/pack/pack_samples.h"

namespace lightwell {
namespace {

constexpr uint64_t seed = 1;

Case light_case(const LightGrid& grid) {
  const LightStream stream = encode_light(grid, {64, seed}).value();
  ByteWriter parameters;
  stream.layout.write(parameters);
  Case one{Room::light, {parameters.release()}};
  for (const LightBundle& bundle : stream.bundles) one.parts.push_back(bundle.payload);
  return one;
}

/// Appends the bytes of an array to a BIN chunk in the making and returns where they begin; 0 when there are none.
template <typename T>
uint32_t place(ByteWriter& bin, const std::vector<T>& values) {
  if (values.empty()) return 0;
  const auto at = static_cast<uint32_t>(bin.size());
  bin.append({reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)});
  return at;
}

/// In so many regions, each with a run of its vertices.
Case mesh_case(const Mesh& mesh, uint16_t regions = 1) {
  Progress silent;
  std::vector<uint16_t> of_vertex;
  const std::vector<float> errors(regions, usual_position_error(max_component(mesh.bounds().size())));
  QuantizeOptions quantize;
  for (size_t v = 0; v < mesh.positions.size() && regions > 1; v++)
    of_vertex.push_back(static_cast<uint16_t>(v * regions / mesh.positions.size()));
  quantize.regions = of_vertex;
  quantize.region_errors = errors;
  const EncodedMesh encoded = encode(build_progressive(mesh, {quantize, 40}, silent).value(), 128);
  const OpenedBase base(encoded.base);
  ByteWriter bin;
  BasePlaces places;
  places.positions = place(bin, base.mesh.positions);
  places.normals = place(bin, base.mesh.normals);
  for (size_t set = 0; set < 2; set++) places.texcoords[set] = place(bin, base.mesh.texcoords[set]);
  places.colors = place(bin, base.colors);
  places.indices = place(bin, base.indices);

  ByteWriter parameters;
  encoded.layout.write(parameters);
  places.write(parameters);
  encoded.layout.write_regions(parameters);
  Case one{Room::mesh, {parameters.release(), bin.release()}};
  for (const MeshBlock& block : encoded.blocks) one.parts.push_back(block.payload);
  return one;
}

Case texture_case(Random& random, uint32_t length) {
  const std::vector<uint8_t> file = random_bytes(random, length);
  Case one{Room::texture, {encode_texture_parameters({length, ImageFormat::webp, 640, 480})}};
  for (const Bytes block : file_blocks(file)) one.parts.emplace_back(block.begin(), block.end());
  return one;
}

/// The same stream for the table of codecs. A mesh has its BIN chunk in front of the payloads.
Case asset_case_of(const Case& one) {
  const bool mesh = one.room == Room::mesh;
  const StreamKind kind = mesh ? StreamKind::mesh : one.room == Room::light ? StreamKind::light : StreamKind::texture;
  const auto payloads = one.parts.begin() + (mesh ? 2 : 1);
  constexpr size_t without_regions = 53;
  const uint8_t codec = !mesh ? 0 : one.parts[0].size() > without_regions ? mesh_codec_regions : mesh_codec_splits;
  return asset_case(kind, one.parts[0], mesh ? one.parts[1] : std::vector<uint8_t>(), {payloads, one.parts.end()},
                    codec);
}

/// A grid of the lattice codec for the table of codecs.
Case lattice_case(const LightGrid& grid, int halvings) {
  const LatticeStream stream = encode_lattice(grid, {.halvings = halvings}).value();
  ByteWriter parameters;
  stream.layout.write(parameters);
  std::vector<std::vector<uint8_t>> payloads;
  for (const LightBundle& bundle : stream.bundles) payloads.push_back(bundle.payload);
  for (const std::vector<LightBundle>& region : stream.regions)
    for (const LightBundle& bundle : region) payloads.push_back(bundle.payload);
  return asset_case(StreamKind::light, parameters.release(), {}, std::move(payloads), light_codec_lattice,
                    static_cast<uint8_t>(stream.regions.size()));
}

}  // namespace

std::vector<Case> generate_cases() {
  Random random(seed, 0);
  std::vector<Case> cases;
  for (const size_t length : {0u, 1u, 100u, 20000u}) cases.push_back({Room::base, {random_bytes(random, length)}});
  for (uint32_t field = 0; field < 4; field++)
    cases.push_back(light_case(lamp_grid(random_shape(random, 3 + 4 * field), field, 0.2f, field % 2 == 1)));
  for (const auto& [name, mesh] : nasty_meshes()) {
    cases.push_back(mesh_case(mesh));
    if (!mesh.faces.empty()) cases.push_back(mesh_case(mesh, 3));
  }
  for (const uint32_t length : {1u, 32768u, 100000u}) cases.push_back(texture_case(random, length));
  for (size_t i = 0, count = cases.size(); i < count; i++)
    if (cases[i].room != Room::base) cases.push_back(asset_case_of(cases[i]));
  for (const int bricks : {0, 1, 20}) cases.push_back(lattice_case(bricked_grid(7, bricks), 0));
  cases.push_back(lattice_case(bricked_grid(4, 60), 2));
  cases.push_back({Room::pack, {make_pack(random_bytes(random, 100), random_streams(seed))}});
  cases.push_back({Room::pack, {sample_pack(sample_scene(2000, 8))}});
  return cases;
}

Case damaged(Case one, Random& random) {
  std::vector<uint8_t>& part = one.parts[random.below(static_cast<uint32_t>(one.parts.size()))];
  if (part.empty()) return one;
  const auto length = static_cast<uint32_t>(part.size());
  if (random.below(4) == 0)
    part.resize(random.below(length));
  else
    for (int i = 0; i < 3; i++) part[random.below(length)] ^= static_cast<uint8_t>(1u << random.below(8));
  return one;
}

}  // namespace lightwell
