// SPDX-License-Identifier: Apache-2.0
//
// The table of codecs: what it opens is what the codec by itself decodes, and what it does not know it refuses.
#include "lightwell/asset/codecs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lightwell/asset/light_asset.h"
#include "lightwell/asset/mesh_asset.h"
#include "lightwell/asset/parts_asset.h"
#include "lightwell/asset/texture_asset.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/mesh/base_places.h"
#include "tests/asset/asset_case.h"
#include "tests/asset/sample_assets.h"
#include "tests/light/brick_fields.h"

namespace lightwell {
namespace {

using testing::HasSubstr;

template <typename T>
bool same(std::span<const T> a, std::span<const T> b) {
  return std::ranges::equal(a, b);
}

void expect_same(const MeshAsset& mesh, const MeshDecoder& decoder) {
  const MeshBuffers buffers = mesh.buffers();
  EXPECT_EQ(buffers.vertices, decoder.vertices());
  EXPECT_EQ(buffers.faces, decoder.faces());
  EXPECT_TRUE(same(buffers.positions, decoder.positions()));
  EXPECT_TRUE(same(buffers.normals, decoder.normals()));
  EXPECT_TRUE(same(buffers.texcoords[0], decoder.texcoords(0)));
  EXPECT_TRUE(same(buffers.texcoords[1], decoder.texcoords(1)));
  EXPECT_TRUE(same(buffers.colors, decoder.colors()));
  EXPECT_TRUE(same(mesh.indices(0), decoder.indices()));
}

void compare_mesh(const SampleAssets& pack, uint32_t stream) {
  AssetContext context = pack.context();
  const auto mesh = open_asset_as<MeshAsset>(pack.reader.directory(), stream, context).value();
  const StreamEntry& entry = pack.entry(stream);
  const MeshParameters parameters = MeshParameters::read(entry.parameters, false).value();
  const BaseArrays base = BaseArrays::read(parameters.layout, parameters.places, pack.bin()).value();
  MeshDecoder decoder = std::move(MeshDecoder::open(parameters.layout, base.view(), entry.length).value());
  expect_same(*mesh, decoder);
  for (const std::vector<uint8_t>& payload : pack.payloads(stream)) {
    ASSERT_TRUE(mesh->append(payload));
    ASSERT_TRUE(decoder.append(payload));
    expect_same(*mesh, decoder);
  }
  EXPECT_TRUE(decoder.complete());
}

void compare_light(const SampleAssets& pack, uint32_t stream) {
  AssetContext context = pack.context();
  const auto light = open_asset_as<LightAsset>(pack.reader.directory(), stream, context).value();
  LightDecoder decoder = LightDecoder::open(pack.entry(stream).parameters, pack.entry(stream).length).value();
  for (const std::vector<uint8_t>& payload : pack.payloads(stream)) {
    ASSERT_TRUE(light->append(payload));
    ASSERT_TRUE(decoder.append(payload));
    EXPECT_EQ(light->received(), decoder.received());
    LightGrid expected = decoder.grid();
    push_pull(expected, decoder.known(), Fill::push_pull);
    const LightGrid filled = light->filled(Fill::push_pull);
    for (size_t i = 0; i < expected.moments.size(); i++)
      ASSERT_EQ(filled.moments[i].m, expected.moments[i].m) << "node " << i;
  }
  EXPECT_TRUE(decoder.complete());
}

void compare_texture(const SampleAssets& pack, uint32_t stream) {
  AssetContext context = pack.context();
  const auto image = open_asset_as<TextureAsset>(pack.reader.directory(), stream, context).value();
  for (const std::vector<uint8_t>& payload : pack.payloads(stream)) ASSERT_TRUE(image->append(payload));
  EXPECT_EQ(image->file(), pack.scene.image);
}

TEST(Codecs, OpenALatticeWithBricks) {
  const LightGrid grid = bricked_grid(3, 20);
  const LatticeStream stream = encode_lattice(grid).value();
  ByteWriter parameters;
  stream.layout.write(parameters);
  Directory directory = directory_of(asset_case(StreamKind::light, parameters.release(), {}, {}, light_codec_lattice));
  for (const LightBundle& bundle : stream.bundles)
    directory.streams[0].length += static_cast<uint32_t>(bundle.payload.size());
  AssetContext context;
  const auto light = open_asset_as<LightAsset>(directory, 0, context).value();
  EXPECT_EQ(light->shape(), grid.shape);
  for (const LightBundle& bundle : stream.bundles) ASSERT_TRUE(light->append(bundle.payload));
  EXPECT_TRUE(light->complete());
  EXPECT_TRUE(light->settle());
  const auto update = std::get<LightUpdate>(light->take(1).value());
  EXPECT_EQ(update.atlas.size(), 8u * update.width * update.height * update.depth);
  EXPECT_EQ(light->filled(Fill::none).bricks.size(), grid.bricks.size());

  AssetContext poor{.bin = {}, .fill = Fill::none, .budget = 1000};
  const auto refused = open_asset(directory, 0, poor);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::limit);
}

/// A grid whose bricks have streams of their own: the directory, and the payloads of each stream.
struct BricksApart {
  LightGrid grid = bricked_grid(4, 60);
  Directory directory;
  std::vector<std::vector<std::vector<uint8_t>>> payloads;

  BricksApart() {
    const LatticeStream stream = encode_lattice(grid, {.halvings = 2}).value();
    ByteWriter parameters;
    stream.layout.write(parameters);
    directory = directory_of(asset_case(StreamKind::light, parameters.release(), {}, {}, light_codec_lattice,
                                        static_cast<uint8_t>(stream.regions.size())));
    add(0, stream.bundles);
    for (size_t region = 0; region < stream.regions.size(); region++) add(1 + region, stream.regions[region]);
  }

 private:
  void add(size_t stream, const std::vector<LightBundle>& bundles) {
    payloads.emplace_back();
    for (const LightBundle& bundle : bundles) {
      payloads.back().push_back(bundle.payload);
      directory.streams[stream].length += static_cast<uint32_t>(bundle.payload.size());
    }
  }
};

TEST(Codecs, BricksApartRefineTheirGrid) {
  const BricksApart pack;
  ASSERT_EQ(pack.payloads.size(), 5u) << "the grid, and four regions";
  AssetContext context;
  const auto light = open_asset_as<LightAsset>(pack.directory, 0, context).value();
  std::vector<std::unique_ptr<AssetDecoder>> bricks;
  for (uint32_t stream = 1; stream < pack.payloads.size(); stream++) {
    bricks.push_back(open_asset(pack.directory, stream, context).value());
    EXPECT_FALSE(bricks.back()->accepts()) << "the grid's own nodes come first";
  }
  for (const std::vector<uint8_t>& payload : pack.payloads[0]) ASSERT_TRUE(light->append(payload));
  EXPECT_TRUE(light->complete());
  EXPECT_LT(light->received(), light->total());
  // The last region first: only its bricks are there then.
  for (size_t i = bricks.size(); i > 0; i--) {
    const size_t before = light->filled(Fill::none).bricks.size();
    ASSERT_TRUE(bricks[i - 1]->accepts());
    for (const std::vector<uint8_t>& payload : pack.payloads[i]) ASSERT_TRUE(bricks[i - 1]->append(payload));
    EXPECT_TRUE(bricks[i - 1]->complete());
    EXPECT_GT(light->filled(Fill::none).bricks.size(), before);
    EXPECT_FALSE(bricks[i - 1]->take(1000)) << "updates are the grid's";
  }
  EXPECT_EQ(light->received(), light->total());
  EXPECT_TRUE(light->settle());
  EXPECT_TRUE(light->take(1));
  EXPECT_EQ(light->filled(Fill::none).bricks.size(), pack.grid.bricks.size());
}

TEST(Codecs, RefuseBricksThatDoNotGoWithTheirGrid) {
  const auto refused = [](const auto& change) {
    BricksApart pack;
    change(pack.directory.streams);
    AssetContext context;
    for (uint32_t stream = 0; stream < pack.directory.streams.size(); stream++)
      if (!open_asset(pack.directory, stream, context)) return true;
    return false;
  };
  const auto parameters = [](uint32_t grid, uint32_t region) {
    ByteWriter writer;
    BricksLayout{grid, region}.write(writer);
    return writer.release();
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto& streams) { streams.pop_back(); })) << "a region without a stream";
  EXPECT_TRUE(refused([](auto& streams) { streams.push_back(streams.back()); })) << "a region with two";
  EXPECT_TRUE(refused([](auto& streams) { std::swap(streams[0], streams[1]); })) << "bricks before their grid";
  EXPECT_TRUE(refused([&](auto& streams) { streams[1].parameters = parameters(0, 99); }));
  EXPECT_TRUE(refused([&](auto& streams) { streams[1].parameters = parameters(99, 0); }));
  EXPECT_TRUE(refused([](auto& streams) { streams[1].parameters.pop_back(); }));
  EXPECT_TRUE(refused([](auto& streams) {
    for (StreamEntry& entry : streams) entry.length = 1;
  })) << "more nodes than bytes";
}

TEST(Codecs, OpenWhatTheCodecByItselfDecodes) {
  const SampleAssets pack;
  std::array<int, 3> kinds{};
  for (uint32_t stream = 0; stream < pack.streams(); stream++) {
    kinds[static_cast<size_t>(pack.entry(stream).kind)]++;
    switch (pack.entry(stream).kind) {
      case StreamKind::light: compare_light(pack, stream); break;
      case StreamKind::mesh: compare_mesh(pack, stream); break;
      case StreamKind::texture: compare_texture(pack, stream); break;
      case StreamKind::bricks:
      case StreamKind::parts: FAIL() << "the sample has none";
    }
  }
  EXPECT_THAT(kinds, testing::Each(testing::Gt(0))) << "a sample of every kind";
}

/// A directory of one stream of parts, which promises so much.
Directory directory_of_parts(uint32_t bytes, uint32_t inflated) {
  Directory directory;
  StreamEntry entry;
  entry.kind = StreamKind::parts;
  entry.codec = parts_codec_gzip;
  entry.length = 100'000;
  entry.parameters = PartsParameters{bytes, inflated}.write();
  directory.streams.push_back(std::move(entry));
  return directory;
}

TEST(Codecs, PartsAreHandedOnOnceTheirFileIsComplete) {
  std::vector<uint8_t> file(file_block_bytes + 100);
  for (size_t i = 0; i < file.size(); i++) file[i] = static_cast<uint8_t>(i * 7);
  AssetContext context;
  auto parts =
      open_asset_as<PartsAsset>(directory_of_parts(static_cast<uint32_t>(file.size()), 99), 0, context).value();
  EXPECT_FALSE(parts->append(Bytes(file).first(10))) << "a block that is too short";
  ASSERT_TRUE(parts->append(Bytes(file).first(file_block_bytes)));
  EXPECT_FALSE(parts->take(1 << 20));
  EXPECT_FALSE(parts->append(Bytes(file).first(file_block_bytes))) << "more than was promised";
  ASSERT_TRUE(parts->append(Bytes(file).last(100)));
  EXPECT_TRUE(parts->complete());
  const auto update = parts->take(1 << 20);
  ASSERT_TRUE(update);
  EXPECT_EQ(std::get<PartsUpdate>(*update).inflated, 99u);
  EXPECT_TRUE(std::ranges::equal(std::get<PartsUpdate>(*update).file, file));
  EXPECT_FALSE(parts->take(1 << 20));
}

TEST(Codecs, PartsThatPromiseTooMuchAreRefused) {
  const auto opens = [](const Directory& directory) {
    AssetContext context;
    return open_asset(directory, 0, context).has_value();
  };
  EXPECT_TRUE(opens(directory_of_parts(1000, 1'064'000)));
  EXPECT_FALSE(opens(directory_of_parts(1000, 1'065'000))) << "more than 2^20 and 16 times its bytes";
  EXPECT_FALSE(opens(directory_of_parts(0, 0)));
  EXPECT_FALSE(opens(directory_of_parts(100'001, 0))) << "more than the stream has";
  Directory directory = directory_of_parts(1000, 1000);
  directory.streams[0].parameters.push_back(0);
  EXPECT_FALSE(opens(directory));
}

TEST(Codecs, UnknownOneIsRefusedByName) {
  const SampleAssets pack;
  Directory directory = pack.reader.directory();
  for (uint32_t stream = 0; stream < pack.streams(); stream++)
    for (int codec = 0; codec < 256; codec++) {
      directory.streams[stream].codec = static_cast<uint8_t>(codec);
      AssetContext context = pack.context();
      const uint64_t before = context.budget;
      const auto opened = open_asset(directory, stream, context);
      const StreamKind kind = pack.entry(stream).kind;
      const bool known = kind == StreamKind::mesh    ? codec == mesh_codec_splits || codec == mesh_codec_regions
                         : kind == StreamKind::light ? codec == light_codec_slices || codec == light_codec_lattice
                                                     : codec == 0;
      if (known) continue;
      ASSERT_FALSE(opened) << "stream " << stream << ", codec " << codec;
      EXPECT_EQ(context.budget, before);
      EXPECT_EQ(opened.error().message(), "stream " + std::to_string(stream) + ": codec: the " +
                                              to_text(pack.entry(stream).kind) + " codec " + std::to_string(codec) +
                                              " is not known to this program");
    }
}

TEST(Codecs, AnotherKindIsRefused) {
  const SampleAssets pack;
  AssetContext context = pack.context();
  for (uint32_t stream = 0; stream <= pack.streams(); stream++) {
    const auto is = [&](StreamKind kind) { return stream < pack.streams() && pack.entry(stream).kind == kind; };
    const Directory& directory = pack.reader.directory();
    EXPECT_EQ(open_asset_as<MeshAsset>(directory, stream, context).has_value(), is(StreamKind::mesh));
    EXPECT_EQ(open_asset_as<LightAsset>(directory, stream, context).has_value(), is(StreamKind::light));
    EXPECT_EQ(open_asset_as<TextureAsset>(directory, stream, context).has_value(), is(StreamKind::texture));
  }
  EXPECT_THAT(open_asset_as<MeshAsset>(pack.reader.directory(), 0, context).error().message(),
              HasSubstr("stream 0: is no mesh stream"));
}

TEST(Codecs, StreamsShareABudgetOfBytes) {
  const SampleAssets pack;
  AssetContext context = pack.context();
  for (uint32_t stream = 0; stream < pack.streams(); stream++) {
    const uint64_t before = context.budget;
    ASSERT_TRUE(open_asset(pack.reader.directory(), stream, context));
    const uint64_t needed = before - context.budget;
    EXPECT_GT(needed, 0u);
    AssetContext exact = pack.context(), short_of_one = pack.context();
    exact.budget = needed;
    short_of_one.budget = needed - 1;
    EXPECT_TRUE(open_asset(pack.reader.directory(), stream, exact));
    EXPECT_EQ(exact.budget, 0u);
    EXPECT_FALSE(open_asset(pack.reader.directory(), stream, short_of_one));
  }
}

// Decoders' memory is bounded by the bytes that the directory says will come.
TEST(Codecs, MoreThanTheStreamsLengthCanHoldIsRefused) {
  const SampleAssets pack;
  Directory directory = pack.reader.directory();
  for (uint32_t stream = 0; stream < pack.streams(); stream++) {
    if (directory.streams[stream].blocks == 0) continue;  // the walls are complete from the start
    directory.streams[stream].length = 10;
    AssetContext context = pack.context();
    EXPECT_FALSE(open_asset(directory, stream, context)) << "stream " << stream;
  }
}

TEST(Codecs, ParametersThatAreCutOrTooLongAreRefused) {
  const SampleAssets pack;
  Directory directory = pack.reader.directory();
  for (uint32_t stream = 0; stream < pack.streams(); stream++) {
    std::vector<uint8_t>& parameters = directory.streams[stream].parameters;
    AssetContext context = pack.context();
    parameters.push_back(0);
    EXPECT_FALSE(open_asset(directory, stream, context));
    while (!parameters.empty()) {
      parameters.pop_back();
      EXPECT_EQ(open_asset(directory, stream, context).has_value(), parameters == pack.entry(stream).parameters);
    }
  }
}

}  // namespace
}  // namespace lightwell
