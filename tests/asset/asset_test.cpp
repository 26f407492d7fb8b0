// SPDX-License-Identifier: Apache-2.0
//
// What decoders hand over, whatever is asked for in which order.
#include "lightwell/asset/asset.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lightwell/asset/light_asset.h"
#include "lightwell/asset/mesh_asset.h"
#include "lightwell/texture/stream.h"
#include "tests/asset/sample_assets.h"

namespace lightwell {
namespace {

/// A mesh as its updates make it up.
struct DrawnMesh {
  std::vector<std::vector<uint8_t>> buffers;  ///< an attribute each, and the indices last
  uint32_t vertices = 0, faces = 0;

  explicit DrawnMesh(const MeshUpdate& update) {
    for (const AttributeLayout& layout : update.attributes)
      buffers.emplace_back(size_t(layout.stride) * update.vertices);
    buffers.emplace_back(size_t(12) * update.faces);
  }
  void apply(const RangeUpdate& update) {
    std::vector<uint8_t>& buffer = buffers[update.buffer == RangeUpdate::indices ? buffers.size() - 1 : update.buffer];
    ASSERT_LE(update.offset + update.data.size(), buffer.size());
    std::ranges::copy(update.data, buffer.begin() + update.offset);
  }
  std::vector<uint32_t> corners() const {
    std::vector<uint32_t> indices(size_t(3) * faces);
    if (!indices.empty()) std::memcpy(indices.data(), buffers.back().data(), indices.size() * 4);
    return indices;
  }
};

class EveryStream : public testing::Test {
 protected:
  std::unique_ptr<AssetDecoder> open(uint32_t stream) {
    AssetContext context = pack.context();
    return std::move(open_asset(pack.reader.directory(), stream, context).value());
  }
  uint32_t first_of(StreamKind kind) const {
    uint32_t stream = 0;
    while (pack.entry(stream).kind != kind) stream++;
    return stream;
  }

  SampleAssets pack;
};

using Assets = EveryStream;

TEST_F(Assets, AreCompleteWithTheLastBlockAndCountAsTheRowsDo) {
  for (uint32_t stream = 0; stream < pack.streams(); stream++) {
    const auto decoder = open(stream);
    for (uint32_t block = 0; block < pack.entry(stream).blocks; block++) {
      EXPECT_FALSE(decoder->complete());
      const uint64_t before = decoder->added();
      ASSERT_TRUE(decoder->append(pack.reader.block(stream, block).value()));
      EXPECT_EQ(decoder->added() - before, pack.reader.rows(stream)[block].adds);
    }
    EXPECT_TRUE(decoder->complete());
    EXPECT_EQ(decoder->decoded(), decoder->total());
  }
}

TEST_F(Assets, AMeshIsHandedOverInPiecesOfAnySize) {
  const uint32_t stream = first_of(StreamKind::mesh);
  for (const size_t budget : {0, 1, 5, 100, 1 << 20}) {
    const auto decoder = open(stream);
    const auto& mesh = static_cast<const MeshAsset&>(*decoder);
    DrawnMesh drawn(std::get<MeshUpdate>(*decoder->announce()));
    for (uint32_t block = 0;; block++) {
      while (const auto update = decoder->take(budget)) {
        if (const auto* range = std::get_if<RangeUpdate>(&*update)) {
          EXPECT_EQ(range->asset, asset_of_stream(stream));
          EXPECT_LE(range->data.size(), std::max<size_t>(budget, 4));
          drawn.apply(*range);
          EXPECT_FALSE(decoder->accepts()) << "a block would move what is half handed over";
        } else {
          const auto& draw = std::get<DrawUpdate>(*update);
          drawn.vertices = draw.vertices;
          drawn.faces = draw.faces;
          ASSERT_TRUE(std::ranges::equal(draw.regions, std::vector{draw.faces}));
        }
        for (const uint32_t corner : drawn.corners()) ASSERT_LT(corner, mesh.buffers().vertices);
      }
      EXPECT_TRUE(decoder->accepts());
      EXPECT_EQ(drawn.vertices, mesh.buffers().vertices);
      EXPECT_EQ(drawn.faces, mesh.buffers().faces);
      const auto indices = mesh.indices(0);
      EXPECT_TRUE(std::ranges::equal(drawn.corners(), indices));
      const size_t length = size_t(12) * drawn.vertices;
      EXPECT_EQ(std::memcmp(drawn.buffers[0].data(), mesh.buffers().positions.data(), length), 0);
      if (block == pack.entry(stream).blocks) break;
      ASSERT_TRUE(decoder->append(pack.reader.block(stream, block).value()));
    }
    EXPECT_TRUE(decoder->complete());
  }
}

TEST_F(Assets, ALightIsFilledWhenAnEighthMoreIsThereAndAtTheEnd) {
  const uint32_t stream = first_of(StreamKind::light);
  const auto decoder = open(stream);
  uint64_t settled = 0;
  for (uint32_t block = 0;; block++) {
    const uint64_t now = decoder->decoded();
    const bool due = now > settled && (now >= settled + settled / 8 || decoder->complete());
    EXPECT_EQ(decoder->settled(), !due);
    EXPECT_EQ(decoder->settle(), due);
    EXPECT_FALSE(decoder->settle());
    const auto update = decoder->take(0);
    ASSERT_EQ(update.has_value(), due);
    if (due) {
      settled = now;
      EXPECT_EQ(std::get<LightUpdate>(*update).nodes, now);
      EXPECT_EQ(std::get<LightUpdate>(*update).asset, asset_of_stream(stream));
    }
    EXPECT_FALSE(decoder->take(0));
    if (block == pack.entry(stream).blocks) break;
    ASSERT_TRUE(decoder->append(pack.reader.block(stream, block).value()));
  }
  EXPECT_EQ(settled, decoder->total());
}

TEST_F(Assets, AnImageIsHandedOverOnceAndWhole) {
  const uint32_t stream = first_of(StreamKind::texture);
  const auto decoder = open(stream);
  for (const auto& payload : pack.payloads(stream)) {
    EXPECT_FALSE(decoder->take(0));
    ASSERT_TRUE(decoder->append(payload));
  }
  const auto update = decoder->take(0);
  ASSERT_TRUE(update);
  EXPECT_TRUE(std::ranges::equal(std::get<TextureUpdate>(*update).file, pack.scene.image));
  EXPECT_FALSE(decoder->take(0));
  EXPECT_FALSE(decoder->append(std::vector<uint8_t>{1})) << "nothing comes behind the end";
}

// A page has made room for it by then.
TEST_F(Assets, AnImageOfAnotherSizeOrFormatThanStatedIsRefused) {
  const uint32_t stream = first_of(StreamKind::texture);
  const TextureParameters stated = decode_texture_parameters(pack.entry(stream).parameters).value();
  TextureParameters wider = stated, lower = stated, jpeg = stated;
  wider.width++;
  lower.height = 1;
  jpeg.format = ImageFormat::jpeg;
  for (const TextureParameters& other : {wider, lower, jpeg}) {
    Directory directory = pack.reader.directory();
    directory.streams[stream].parameters = encode_texture_parameters(other);
    AssetContext context = pack.context();
    const auto decoder = open_asset(directory, stream, context).value();
    const auto payloads = pack.payloads(stream);
    for (size_t i = 0; i + 1 < payloads.size(); i++) ASSERT_TRUE(decoder->append(payloads[i]));
    EXPECT_FALSE(decoder->append(payloads.back()));
  }
}

}  // namespace
}  // namespace lightwell
