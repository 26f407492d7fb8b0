// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/result.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(Error, SaysWhatIsKnownOfIt) {
  EXPECT_EQ(Error("room.glb", "nodes[3]", "is its own ancestor").message(), "room.glb: nodes[3]: is its own ancestor");
  EXPECT_EQ(Error("", "", "is empty").message(), "is empty");
  EXPECT_EQ(Error("room.glb", "", "is cut short", ErrorKind::bad_input, 12).message(),
            "room.glb: is cut short (at byte 12)");
}

TEST(Error, IsBadInputUnlessSaidOtherwise) {
  EXPECT_EQ(fail("grid", "has no nodes").value().kind, ErrorKind::bad_input);
  EXPECT_EQ(fail(ErrorKind::limit, "grid", "has too many nodes").value().kind, ErrorKind::limit);
}

TEST(Error, KeepsItsKindAndItsByteWhileCallersAddToIt) {
  const Error inner("", "JSON", "syntax error", ErrorKind::unsupported, 7);
  const Error outer = at_byte(in_file(in_element(inner, "buffers[0]"), "room.gltf"), 9);
  EXPECT_EQ(outer.message(), "room.gltf: buffers[0]: JSON: syntax error (at byte 7)");
  EXPECT_EQ(outer.kind, ErrorKind::unsupported);
  EXPECT_EQ(at_byte(Error("", "chunk", "stands twice"), 9).offset, 9u);
}

TEST(Error, OfAFileBesideAnotherNamesBoth) {
  const Error beside("wall.bin", "", "No such file or directory", ErrorKind::io);
  EXPECT_EQ(in_file(in_element(beside, "buffers[0]"), "room.gltf").message(),
            "room.gltf: buffers[0]: wall.bin: No such file or directory");
  EXPECT_EQ(in_file(beside, "room.gltf").message(), "wall.bin: No such file or directory");
}

}  // namespace
}  // namespace lightwell
