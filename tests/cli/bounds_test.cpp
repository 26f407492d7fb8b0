// SPDX-License-Identifier: Apache-2.0
//
// Scenes of very many parts, and the end of memory.
#include <sys/resource.h>

#include <cmath>

#include "lightwell/base/file.h"
#include "lightwell/cli/memory_limit.h"
#include "lightwell/scene/import_obj.h"
#include "lightwell/scene/scene_builder.h"
#include "tests/address_sanitizer.h"
#include "tests/cli/commands.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

class Bounds : public Commands {
 protected:
  /// Boxes with a material each, all of them in one place or side by side, under a lamp.
  std::string boxes(int count, bool coincident) const {
    SceneBuilder scene;
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < count; i++) {
      const float x = coincident ? 0.f : 2.f * static_cast<float>(i % side);
      const float z = coincident ? 0.f : 2.f * static_cast<float>(i / side);
      const float shade = static_cast<float>(i + 1) / static_cast<float>(count + 1);
      const int material = scene.material(Lambertian{.name = std::to_string(i), .color = Vec3f::filled(shade)});
      scene.object("box", {{block({{x, 0, z}}, {{x + 1, 1, z + 1}}), material}});
    }
    const int lamp = scene.material(Lambertian{.name = "lamp", .emission = Vec3f::filled(5)});
    scene.object("lamp", {{quad({{0, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}}), lamp}});
    Report report;
    const std::string name = path(std::to_string(count) + (coincident ? "_in_one_place.glb" : "_spread.glb"));
    EXPECT_TRUE(write_file(name, write_glb(scene.release(), report).value()));
    return name;
  }

  /// An OBJ of a triangle for each of the first `used` of its materials, and a lamp of another material.
  std::string obj(int materials, int used) const {
    std::ofstream mtl(path("parts.mtl")), faces(path("parts.obj"));
    mtl << "newmtl lamp\nKe 5 5 5\n";
    for (int i = 0; i < materials; i++) mtl << "newmtl m" << i << "\nKd " << (i + 1.0) / (materials + 1.0) << " 0 0\n";
    faces << "mtllib parts.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\nusemtl lamp\nf 2 3 4\n";
    for (int i = 0; i < used; i++) faces << "usemtl m" << i << "\nf 1 2 3\n";
    return path("parts.obj");
  }

  /// The most bytes that a small bake had at one time.
  double memory_of_bake(const std::string& scene) const {
    const Outcome baked = run("bake " + scene + " --grid 2 --threads 1 --quiet --json -o " + path("pack.glb"));
    EXPECT_EQ(baked.status, 0) << baked.err;
    if (baked.status != 0) return 0;
    const json figures = json::parse(baked.out);
    const double peak = figures["peak_memory"], expected = figures["expected_memory"];
    EXPECT_LT(peak, with_sanitizer * 1.3 * expected) << scene;
    return peak;
  }

  /// Processor seconds of a small bake.
  double seconds_of_bake(const std::string& scene) const {
    const double before = seconds_of_children();
    const Outcome baked = run("bake " + scene + " --grid 4 --threads 1 --quiet -o " + path("pack.glb"));
    EXPECT_EQ(baked.status, 0) << baked.err;
    return seconds_of_children() - before;
  }

  /// What is said under a limit of address space; nothing of the program's own may be said instead.
  void expect_a_line_or_success(int megabytes, const std::string& arguments) const {
    const Outcome outcome = run_in_shell("ulimit -v " + std::to_string(megabytes << 10) + "; " LIGHTWELL_PROGRAM " " +
                                         arguments + " --quiet" + redirected());
    SCOPED_TRACE(arguments + " in " + std::to_string(megabytes) + " MB: " + outcome.err);
    if (outcome.status == 0) return;
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.lines(), 1u);
    EXPECT_TRUE(outcome.err.starts_with("lightwell: "));
  }

 private:
  static double seconds_of_children() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
};

// Four times as many boxes in linear time are four times the work, in quadratic time sixteen times: nine tells the two
// apart whatever else the machine does.
TEST_F(Bounds, PartsInOnePlaceAreBakedInLinearTime) {
  const double few = seconds_of_bake(boxes(1000, true)), many = seconds_of_bake(boxes(4000, true));
  EXPECT_LT(many, 9 * few);
}

TEST_F(Bounds, PartsSideBySideAreBakedInLinearTime) {
  const double few = seconds_of_bake(boxes(1000, false)), many = seconds_of_bake(boxes(4000, false));
  EXPECT_LT(many, 9 * few);
}

// A hundred thousand are to fit into a gigabyte.
TEST_F(Bounds, APartTakesTenKilobytes) {
  const double few = memory_of_bake(boxes(2000, false)), many = memory_of_bake(boxes(12000, false));
  EXPECT_LT((many - few) / 10000, with_sanitizer * 10e3);
}

TEST_F(Bounds, ABakeTakesWhatItSaysBeforehand) {
  const Outcome baked = run("bake box -o " + path("box.glb") + " --target-error 4 --json");
  ASSERT_EQ(baked.status, 0) << baked.err;
  const json figures = json::parse(baked.out);
  const double peak = figures["peak_memory"], expected = figures["expected_memory"];
  EXPECT_LT(peak, with_sanitizer * 1.3 * expected);
  EXPECT_GT(with_sanitizer * peak, expected / 2);  // a million triangles are most of it
  const size_t said = baked.err.find("memory: up to about ");
  ASSERT_NE(said, std::string::npos) << baked.err;
  EXPECT_LT(said, baked.err.find("light"));
}

// The library would keep kilobytes of each. What is kept here are a few numbers, a name and the place by that name.
TEST_F(Bounds, AMaterialThatNothingUsesTakesHundredsOfBytes) {
  const double few = memory_of_bake(obj(1, 1)), many = memory_of_bake(obj(300000, 1));
  EXPECT_LT((many - few) / 300000, with_sanitizer * 1000);
}

TEST_F(Bounds, AnObjOfVeryManyPartsIsRefused) {
  const int most = static_cast<int>(most_obj_parts);
  const Outcome refused = run("bake " + obj(most, most) + " --grid 2 --quiet -o " + path("pack.glb"));
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.lines(), 1u) << refused.err;
  EXPECT_NE(refused.err.find(std::to_string(most)), std::string::npos) << refused.err;
}

TEST_F(Bounds, WhatCannotFitIsRefusedBeforehand) {
  Scene scene = scene_of(quad({}, {{1, 0, 0}}, {{0, 1, 0}}), lambertian(0.5f));
  const uint64_t small = least_memory(scene);
  EXPECT_TRUE(check_memory(scene, small));
  EXPECT_FALSE(check_memory(scene, small - 1));
  scene.primitives[0].mesh.faces.resize(1000000);
  const auto refused = check_memory(scene, uint64_t(64) << 20);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("--memory-limit"), std::string::npos) << refused.error().message();
  EXPECT_LE(machine_memory(), uint64_t(1) << 60);
  EXPECT_GE(machine_memory(), uint64_t(1) << 20);
}

TEST_F(Bounds, AMemoryLimitHolds) {
  if (with_sanitizer > 1) GTEST_SKIP() << "left out: the sanitizer's own memory is beyond any such limit";
  const std::string scene = boxes(1000, false);
  const std::string bake =
      "bake " + scene + " --grid 2 --threads 1 --quiet -o " + path("pack.glb") + " --memory-limit ";
  EXPECT_EQ(run(bake + "4G").status, 0);
  const Outcome refused = run(bake + "2M");
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.lines(), 1u) << refused.err;
  const Outcome meaningless = run(bake + "much");
  EXPECT_EQ(meaningless.status, 2) << meaningless.err;
}

// Whatever is under way when memory ends: reading JSON and taking it apart again, Embree's tree and threads, pictures.
TEST_F(Bounds, WhereMemoryEndsOneLineSaysSo) {
  if (with_sanitizer > 1) GTEST_SKIP() << "left out: the sanitizer's own memory is beyond any such limit";
  const std::string scene = boxes(5000, false), pack = small_pack();
  for (int megabytes = 128; megabytes <= 512; megabytes += megabytes / 2) {
    expect_a_line_or_success(megabytes, "bake " + scene + " --grid 2 -o " + path("pack.glb"));
    expect_a_line_or_success(megabytes, "render " + pack + " --integrator ivg --size 8x6 --spp 1 -o " + path("a.png"));
    expect_a_line_or_success(megabytes, "verify " + pack);
  }
}

}  // namespace
}  // namespace lightwell
