// SPDX-License-Identifier: Apache-2.0
//
// Meshes of several regions, each drawn by itself: what they share, and that they stay together.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "lightwell/mesh/base_places.h"
#include "lightwell/mesh/progressive.h"
#include "lightwell/mesh/stream.h"
#include "tests/mesh/shapes.h"
#include "tests/mesh/streams.h"

namespace lightwell {
namespace {

Progress silent;

/// A mesh whose faces are dealt out to regions; vertices are those of one region each, as those of glTF's primitives.
struct Regions {
  Mesh mesh;
  std::vector<uint16_t> of_vertex;
  std::vector<float> errors;

  QuantizeOptions options() const {
    QuantizeOptions options;
    options.regions = of_vertex;
    options.region_errors = errors;
    return options;
  }
};

/// `region_of` says of each face to which of `count` regions it belongs. The lattices are of different steps.
template <typename RegionOf>
Regions cut(const Mesh& whole, uint16_t count, const RegionOf& region_of) {
  Regions out;
  std::map<std::pair<uint32_t, uint16_t>, uint32_t> numbers;
  for (uint32_t f = 0; f < whole.faces.size(); f++) {
    const uint16_t region = region_of(f);
    Face face = whole.faces[f];
    for (uint32_t& v : face) {
      const auto [known, is_new] = numbers.emplace(std::pair(v, region), static_cast<uint32_t>(out.of_vertex.size()));
      if (is_new) {
        out.of_vertex.push_back(region);
        out.mesh.positions.push_back(whole.positions[v]);
        if (!whole.normals.empty()) out.mesh.normals.push_back(whole.normals[v]);
        for (size_t set = 0; set < 2; set++)
          if (!whole.texcoords[set].empty()) out.mesh.texcoords[set].push_back(whole.texcoords[set][v]);
        if (!whole.colors.empty()) out.mesh.colors.push_back(whole.colors[v]);
      }
      v = known->second;
    }
    out.mesh.faces.push_back(face);
  }
  const float usual = usual_position_error(max_component(whole.bounds().size()));
  for (uint16_t region = 0; region < count; region++) out.errors.push_back(std::ldexp(usual, region % 3 - 1));
  return out;
}

Regions cut_at_random(const Mesh& whole, uint16_t count, uint64_t seed) {
  Random random(seed, 3);
  // Runs of faces, so that regions have an inside.
  std::vector<uint16_t> regions;
  while (regions.size() < whole.faces.size())
    regions.insert(regions.end(), 1 + random.below(40), static_cast<uint16_t>(random.below(count)));
  return cut(whole, count, [&](uint32_t f) { return regions[f]; });
}

Stream stream_of(const Regions& regions, uint32_t base_vertices = 4, uint32_t block_vertices = 20) {
  return stream_of(regions.mesh, SimplifyOptions{regions.options(), base_vertices}, block_vertices);
}

/// What a region of a decoder shows.
Mesh shown_region(const MeshDecoder& decoder, size_t region) {
  Mesh mesh = shown(decoder, region);
  mesh.normals.clear();  // they come later
  return mesh;
}

/// What a region of a quantised mesh shows.
Mesh region_of(const QuantizedMesh& quantized, size_t region) {
  Mesh mesh = dequantize(quantized);
  mesh.normals.clear();
  mesh.faces.clear();
  for (size_t f = 0; f < quantized.faces.size(); f++)
    if (quantized.regions[f] == region) mesh.faces.push_back(quantized.faces[f]);
  return mesh;
}

/// By how much each edge between two places has more faces on one side than on the other; nothing for a closed surface.
std::map<std::pair<Vec3f, Vec3f>, int> open_edges(const MeshDecoder& decoder) {
  std::map<std::pair<Vec3f, Vec3f>, int> edges;
  for (size_t region = 0; region < decoder.layout().region_count(); region++) {
    const auto indices = decoder.indices(region);
    for (size_t i = 0; i < indices.size(); i++) {
      const Vec3f &a = decoder.positions()[indices[i]], &b = decoder.positions()[indices[i - i % 3 + (i + 1) % 3]];
      if (a != b) edges[a < b ? std::pair(a, b) : std::pair(b, a)] += a < b ? 1 : -1;
    }
  }
  std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
  return edges;
}

TEST(MeshRegions, FinalLevelIsTheQuantisedInputRegionByRegion) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    if (mesh.faces.empty()) continue;
    const uint16_t count = 3;
    const Regions regions = cut_at_random(mesh, count, 5);
    const Stream stream = stream_of(regions);
    MeshDecoder decoder = open(stream.encoded);
    for (const MeshBlock& block : stream.encoded.blocks) ASSERT_TRUE(decoder.append(block.payload));
    EXPECT_TRUE(decoder.complete());
    const QuantizedMesh input = *quantize(regions.mesh, regions.options());
    for (size_t region = 0; region < count; region++) {
      EXPECT_EQ(faces_of(shown_region(decoder, region)), faces_of(region_of(input, region))) << "region " << region;
      EXPECT_EQ(decoder.indices(region).size(), size_t(3) * decoder.layout().regions[region].faces);
    }
  }
}

TEST(MeshRegions, EveryLevelIsDrawableAndEachRegionHasAFace) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    if (mesh.faces.empty()) continue;
    const Stream stream = stream_of(cut_at_random(mesh, 4, 6), 4, mesh.faces.size() > 1000 ? 200 : 20);
    MeshDecoder decoder = open(stream.encoded);
    std::vector<bool> has_more_than_loose(4);
    const auto& quantized = stream.progressive.mesh;
    for (size_t f = 0; f + stream.progressive.loose_faces < quantized.faces.size(); f++)
      has_more_than_loose[quantized.regions[f]] = true;
    for (size_t i = 0;; i++) {
      size_t faces = 0;
      for (size_t region = 0; region < 4; region++) {
        const auto indices = decoder.indices(region);
        for (const uint32_t v : indices) ASSERT_LT(v, decoder.vertices());
        faces += indices.size() / 3;
        const bool loose_come = decoder.faces() > decoder.layout().faces - decoder.layout().loose_faces;
        if (has_more_than_loose[region] || !loose_come) {
          EXPECT_EQ(!indices.empty(), has_more_than_loose[region]) << "region " << region;
        }
      }
      ASSERT_EQ(faces, decoder.faces());
      if (i == stream.encoded.blocks.size()) break;
      ASSERT_TRUE(decoder.append(stream.encoded.blocks[i].payload));
    }
  }
}

// The reason why regions share a stream: borders between them that open show what is behind.
TEST(MeshRegions, AClosedSurfaceStaysClosedAtEveryLevel) {
  for (const Mesh& mesh : {knot(60, 20), seamed_sphere(24, 40), faceted_torus(20, 10)}) {
    const Stream stream = stream_of(cut_at_random(mesh, 6, 7), 4, 30);
    MeshDecoder decoder = open(stream.encoded);
    ASSERT_GT(stream.encoded.blocks.size(), 4u);
    for (const MeshBlock& block : stream.encoded.blocks) {
      ASSERT_EQ(open_edges(decoder).size(), 0u) << "with " << decoder.vertices() << " vertices";
      ASSERT_TRUE(decoder.append(block.payload));
    }
    EXPECT_EQ(open_edges(decoder).size(), 0u);
  }
}

// Two halves of a sheet, coloured apart: the line between them is no more crooked at a coarse level than its outline.
TEST(MeshRegions, BordersBetweenThemAreKeptLikeOuterOnes) {
  const Mesh mesh = sheet(40);
  const Regions halves = cut(mesh, 2, [&](uint32_t f) { return mesh.positions[mesh.faces[f][0]][0] < 20 ? 0 : 1; });
  const Stream stream = stream_of(halves, 40, 100);
  MeshDecoder decoder = open(stream.encoded);
  ASSERT_LT(decoder.faces(), mesh.faces.size() / 10);
  for (const size_t region : {0, 1})
    for (const uint32_t v : decoder.indices(region)) {
      const float x = decoder.positions()[v][0];
      EXPECT_TRUE(region == 0 ? x <= 20 : x >= 20) << "a vertex at " << x << " in region " << region;
    }
}

// Each on the lattice of its region; where they touch, all on the coarsest of those that do.
TEST(MeshRegions, PositionsLieOnTheLatticesOfTheirRegions) {
  const Mesh mesh = knot(60, 20);
  const Regions regions = cut_at_random(mesh, 6, 8);
  const QuantizedMesh quantized = *quantize(regions.mesh, regions.options());
  std::map<Vec3i, std::set<uint16_t>> at;
  for (size_t f = 0; f < quantized.faces.size(); f++)
    for (const uint32_t v : quantized.faces[f]) at[quantized.positions[v]].insert(quantized.regions[f]);
  ASSERT_EQ(quantized.region_shifts, (std::vector<uint8_t>{0, 1, 2, 0, 1, 2}));
  size_t touching = 0;
  for (const auto& [position, found] : at) {
    uint8_t shift = 0;
    for (const uint16_t region : found) shift = std::max(shift, quantized.region_shifts[region]);
    touching += found.size() > 1;
    for (int i = 0; i < 3; i++) EXPECT_EQ(position[i] & ((1 << shift) - 1), 0);
  }
  EXPECT_GT(touching, 100u);
  EXPECT_LT(touching, at.size());
}

// What one stream costs: hardly more than the mesh in one piece (a region for each face that comes, positions on three
// lattices, borders that may not move).
TEST(MeshRegions, CostLittle) {
  const Mesh mesh = knot(120, 40);
  Regions regions = cut(mesh, 4, [&](uint32_t f) { return static_cast<uint16_t>(4 * f / mesh.faces.size()); });
  regions.errors.assign(4, usual_position_error(max_component(mesh.bounds().size())));
  const Stream stream = stream_of(regions, 100, 1000);
  const uint64_t whole = stream_bytes(encode(*build_progressive(mesh, {{}, 100}, silent)));
  EXPECT_LT(static_cast<double>(stream_bytes(stream.encoded)), 1.05 * static_cast<double>(whole));
}

TEST(MeshRegions, EveryPrefixAndAnyBytesAreSurvived) {
  const Stream stream = stream_of(cut_at_random(knot(40, 12), 5, 9), 30, 60);
  Random random(10, 0);
  for (int i = 0; i < 200; i++) {
    MeshDecoder decoder = open(stream.encoded);
    for (const MeshBlock& block : stream.encoded.blocks) {
      std::vector<uint8_t> payload = block.payload;
      if (random.below(3) == 0) payload.resize(random.below(static_cast<uint32_t>(payload.size())));
      for (uint32_t k = random.below(4); k > 0 && !payload.empty(); k--)
        payload[random.below(static_cast<uint32_t>(payload.size()))] ^= static_cast<uint8_t>(1u << random.below(8));
      const bool good = decoder.append(payload).has_value();
      size_t faces = 0;
      for (size_t region = 0; region < 5; region++) {
        const auto indices = decoder.indices(region);
        ASSERT_LE(indices.size(), size_t(3) * decoder.layout().regions[region].faces);
        for (const uint32_t v : indices) ASSERT_LT(v, decoder.vertices());
        faces += indices.size() / 3;
      }
      ASSERT_EQ(faces, decoder.faces());
      if (!good) break;
    }
  }
}

TEST(MeshRegions, ChangesLeadFromLevelToLevel) {
  const Stream stream = stream_of(cut_at_random(knot(60, 20), 5, 11), 50, 100);
  MeshDecoder decoder = open(stream.encoded);
  std::vector<uint32_t> copy(3 * size_t(decoder.layout().faces));
  const auto follow = [&] {
    const MeshChanges changes = decoder.take_changes();
    for (const auto* ranges : {&changes.indices, &changes.rewired})
      for (const BufferRange& range : *ranges)
        for (uint32_t i = range.first; i < range.first + range.count; i++) copy[i] = decoder.index_buffer()[i];
    size_t first = 0;
    for (size_t region = 0; region < 5; region++) {
      const auto now = decoder.indices(region);
      ASSERT_TRUE(std::ranges::equal(std::span(copy).subspan(first, now.size()), now));
      first += size_t(3) * decoder.layout().regions[region].faces;
    }
  };
  follow();
  for (const MeshBlock& block : stream.encoded.blocks) {
    ASSERT_TRUE(decoder.append(block.payload));
    follow();
  }
}

TEST(MeshRegions, LayoutsAreReadAndLiesRefused) {
  const EncodedMesh encoded = stream_of(cut_at_random(knot(40, 12), 5, 12)).encoded;
  const auto written = [](const MeshLayout& layout) {
    ByteWriter writer;
    layout.write(writer);
    BasePlaces().write(writer);
    layout.write_regions(writer);
    return writer.release();
  };
  const std::vector<uint8_t> bytes = written(encoded.layout);
  const auto read = MeshParameters::read(bytes, true);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->layout.regions, encoded.layout.regions);
  EXPECT_FALSE(MeshParameters::read(bytes, false));
  for (size_t length = 0; length < bytes.size(); length++)
    EXPECT_FALSE(MeshParameters::read(Bytes(bytes).first(length), true)) << length;
  const auto possible = [&](auto lie) {
    MeshLayout layout = encoded.layout;
    lie(layout);
    return MeshParameters::read(written(layout), true).has_value();
  };
  EXPECT_TRUE(possible([](MeshLayout&) {}));
  EXPECT_FALSE(possible([](MeshLayout& l) { l.regions[0].faces++; }));
  EXPECT_FALSE(possible([](MeshLayout& l) { l.regions[0].base_faces++; }));
  EXPECT_FALSE(possible([](MeshLayout& l) { l.regions[0].shift = 21; }));
  EXPECT_FALSE(possible([](MeshLayout& l) { l.regions.resize(1); }));
  EXPECT_FALSE(possible([](MeshLayout& l) { l.regions.resize(2000); }));
}

}  // namespace
}  // namespace lightwell
