// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "lightwell/scene/scene.h"
#include "tests/temporary_folder.h"

namespace lightwell {
namespace {

// A triangle with its right angle at the origin, 300 cm along x and 200 cm upwards: z is up.
const std::string collada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 300 0 0 0 0 200</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

TEST(ImportAssimp, ReadsColladaWhereItIsBuiltIn) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write("triangle.dae", collada);
  Report report;
  const auto scene = load_scene(path.string(), {}, report);
#ifdef LIGHTWELL_ASSIMP
  ASSERT_TRUE(scene) << scene.error().message();
  constexpr float rounding = 1e-5f;  // of a unit and a turn in floats
  EXPECT_LE(length(scene->bounds().size() - Vec3f{{3, 2, 0}}), rounding);
#else
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().reason, "cannot be read: it is an XML file");
#endif
}

}  // namespace
}  // namespace lightwell
