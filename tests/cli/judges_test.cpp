// SPDX-License-Identifier: Apache-2.0
//
// Whether `verify` and the commands that use a pack judge it alike.
#include <cstdlib>

#include "tests/packing/spoilt_packs.h"

// Behind the others, whose variables its name `json` would shadow.
#include "lightwell/base/file.h"
#include "lightwell/cli/command.h"
#include "tests/cli/commands.h"

namespace lightwell {
namespace {

/// Runs a command of the program in this process, which is a hundred times faster. What it says comes back with its
/// status.
Outcome run_here(std::vector<std::string> arguments) {
  CLI::App program;
  Console console{.json = true, .quiet = true};
  std::function<int()> chosen;
  for (const AddCommand add : {add_info, add_verify, add_fetch, add_render, add_probe, add_export})
    add(program, console, chosen);
  std::ranges::reverse(arguments);  // as CLI11 takes them
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  int status = -1;
  std::string thrown;
  try {
    program.parse(arguments);
    status = chosen();
  } catch (const std::exception& exception) {
    thrown = exception.what();
  }
  std::fflush(stdout);
  return {status, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr() + thrown};
}

/// All meshes of a file without streams, and all its images.
std::pair<std::vector<Mesh>, std::vector<std::vector<uint8_t>>> content_of(const std::string& file) {
  Report report;
  const std::vector<uint8_t> bytes = read_file(file).value();
  const Document document = read_document(Bytes(bytes), {}, report).value();
  std::pair<std::vector<Mesh>, std::vector<std::vector<uint8_t>>> content;
  const Json& meshes = member(document.json, "meshes");
  for (size_t i = 0; i < meshes.size(); i++)
    for (size_t k = 0; k < meshes[i]["primitives"].size(); k++)
      if (auto mesh = read_primitive(document, static_cast<int>(i), static_cast<int>(k), report))
        content.first.push_back(std::move(*mesh));
  for (size_t i = 0; i < member(document.json, "images").size(); i++)
    content.second.push_back(read_image(document, static_cast<int>(i)).value_or(std::vector<uint8_t>()));
  return content;
}

class Judges : public Commands {
 protected:
  /// What uses a pack, in the shortest way that reads all of it.
  std::vector<std::vector<std::string>> uses(const std::string& pack) const {
    return {{"info", pack, "--blocks"},
            {"fetch", pack, "-o", path("fetched.glb")},
            {"export", pack, "-o", path("exported.glb")},
            {"export", pack, "--level", "0", "-o", path("exported.ply")},
            {"export", pack, "--light", path("exported.ktx2")},
            {"probe", pack, "--points", path("points.csv"), "--integrator", "ivg", "--threads", "1"},
            {"render", pack, "--integrator", "ivg", "--size", "4x3", "--spp", "1", "--threads", "1", "-o",
             path("picture.png")}};
  }

  void expect_all_take(const std::string& pack) const {
    for (const std::vector<std::string>& use : uses(pack)) {
      const Outcome outcome = run_here(use);
      EXPECT_EQ(outcome.status, 0) << use.front() << ": " << outcome.err;
    }
    if (HasFailure()) return;
    const auto [fetched, fetched_images] = content_of(path("fetched.glb"));
    const auto [exported, exported_images] = content_of(path("exported.glb"));
    EXPECT_EQ(fetched_images, exported_images);
    ASSERT_EQ(fetched.size(), exported.size());
    for (size_t i = 0; i < fetched.size(); i++) {
      EXPECT_EQ(fetched[i].positions, exported[i].positions);
      EXPECT_EQ(fetched[i].texcoords, exported[i].texcoords);
      EXPECT_EQ(fetched[i].faces, exported[i].faces);
    }
  }
};

TEST_F(Judges, WhatVerifyAcceptsEveryCommandTakes) {
  const Packed packed = pack_of_everything();
  const OpenedPack sound = open(packed.file);
  const std::vector<PackStream> streams = streams_of(sound.reader());
  const std::string file = path("room.lw.glb");
  write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0.5,0,0,1\n");
  ASSERT_TRUE(write_file(file, packed.file));
  ASSERT_EQ(run_here({"verify", file}).status, 0);
  expect_all_take(file);
  const char* scale = std::getenv("LIGHTWELL_TEST_SCALE");
  const int edits = 150 * (scale != nullptr ? std::atoi(scale) : 1);
  int accepted = 0;
  for (int edit = 0; edit < edits; edit++) {
    SCOPED_TRACE("edit " + std::to_string(edit));
    ASSERT_TRUE(write_file(file, spoilt_pack(sound, streams, static_cast<uint64_t>(edit))));
    const Outcome verified = run_here({"verify", file});
    ASSERT_TRUE(verified.status == 0 || verified.status == 1) << verified.err;
    if (verified.status != 0) continue;
    accepted++;
    expect_all_take(file);
  }
  // Were all accepted, or none, then the edits would prove nothing.
  EXPECT_GT(accepted, edits / 20);
  EXPECT_LT(accepted, edits / 2);
}

}  // namespace
}  // namespace lightwell
