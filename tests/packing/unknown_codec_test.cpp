// SPDX-License-Identifier: Apache-2.0
//
// What fetch refuses, verify and export refuse as well: packs whose checks are right, of a codec that nobody knows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify.h"
#include "tests/packing/sample_scenes.h"

namespace lightwell {
namespace {

using testing::Contains;

// A pack of a stream of each kind.
Packed pack_of_each_kind() {
  Document document = sheet_document(50);
  add_noise(document, 32);
  return pack(std::move(document));
}

TEST(UnknownCodec, IsRefusedByVerifyAndUnpack) {
  const Packed packed = pack_of_each_kind();
  const OpenedPack sound = open(packed.file);
  ASSERT_TRUE(verify_pack(sound).errors.empty()) << verify_pack(sound).errors.front();
  std::set<StreamKind> kinds;
  for (size_t stream = 0; stream < sound.reader().directory().streams.size(); stream++) {
    const StreamKind kind = sound.reader().directory().streams[stream].kind;
    kinds.insert(kind);
    const std::vector<uint8_t> file = with_codec(sound.reader(), stream, 7);
    const OpenedPack changed = open(file);
    ASSERT_NE(changed.reader().directory().id, sound.reader().directory().id);
    const std::string complaint =
        "stream " + std::to_string(stream) + ": codec: the " + to_text(kind) + " codec 7 is not known to this program";
    EXPECT_THAT(verify_pack(changed).errors, Contains(complaint));
    Report report;
    const Result<void> unpacked = kind == StreamKind::light
                                      ? unpack_light(changed.reader(), stream, {}).map([](const LightGrid&) {})
                                      : unpack_document(changed, {}, report).map([](const Document&) {});
    ASSERT_FALSE(unpacked);
    EXPECT_EQ(unpacked.error().message(), complaint);
    EXPECT_EQ(unpacked.error().kind, ErrorKind::unsupported);
  }
  EXPECT_EQ(kinds.size(), 3u);
}

TEST(UnknownCodec, KindIsRefusedWithTheDirectory) {
  const Packed packed = pack_of_each_kind();
  Directory one = open(packed.file).reader().directory();
  one.streams[0].kind = static_cast<StreamKind>(stream_kinds);
  const auto read = Directory::read(one.write(), packed.file.size());
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message(), testing::HasSubstr("unknown kind " + std::to_string(stream_kinds)));
}

}  // namespace
}  // namespace lightwell
