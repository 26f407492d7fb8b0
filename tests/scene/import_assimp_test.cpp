// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <zlib.h>

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

// The same with y up, as Blender and Maya write it: units of a hundredth of a metre.
const std::string fbx = R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",1
		P: "UpAxisSign", "int", "Integer", "",1
		P: "FrontAxis", "int", "Integer", "",2
		P: "FrontAxisSign", "int", "Integer", "",1
		P: "CoordAxis", "int", "Integer", "",0
		P: "CoordAxisSign", "int", "Integer", "",1
		P: "UnitScaleFactor", "double", "Number", "",1
	}
}
Objects:  {
	Geometry: 1, "Geometry::g", "Mesh" {
		Vertices: *9 {
			a: 0,0,0,300,0,0,0,200,0
		}
		PolygonVertexIndex: *3 {
			a: 0,1,-3
		}
		GeometryVersion: 124
	}
	Model: 2, "Model::m", "Mesh" {
		Version: 232
	}
}
Connections:  {
	C: "OO",1,2
	C: "OO",2,0
}
)";

const std::string three_mf = R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources><object id="1" type="model"><mesh>
<vertices><vertex x="0" y="0" z="0"/><vertex x="30" y="0" z="0"/><vertex x="0" y="20" z="0"/></vertices>
<triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object></resources>
<build><item objectid="1"/></build></model>
)";

const std::string relationships = R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="rel0"
Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
)";

const std::string content_types = R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
)";

void append(std::string& bytes, uint32_t value, int size) {
  for (int i = 0; i < size; i++) bytes += static_cast<char>(value >> (8 * i));
}

// A ZIP archive of files that are not compressed (PKWARE's APPNOTE, sections 4.3.7, 4.3.12 and 4.3.16).
std::string archive_of(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, directory;
  for (const auto& [name, content] : files) {
    const auto sum = static_cast<uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
    std::string description;
    append(description, 20, 2);                             // version of the format
    for (int i = 0; i < 4; i++) append(description, 0, 2);  // flags, method, time and date
    append(description, sum, 4);
    append(description, static_cast<uint32_t>(content.size()), 4);
    append(description, static_cast<uint32_t>(content.size()), 4);
    append(description, static_cast<uint32_t>(name.size()), 2);
    append(description, 0, 2);
    directory += std::string("PK\x01\x02\x14\x00", 6) + description + std::string(10, '\0');  // no comment, disk 0
    append(directory, static_cast<uint32_t>(archive.size()), 4);
    directory += name;
    archive += "PK\x03\x04" + description + name + content;
  }
  const auto begin = static_cast<uint32_t>(archive.size());
  archive += directory + std::string("PK\x05\x06\0\0\0\0", 8);
  for (int i = 0; i < 2; i++) append(archive, static_cast<uint32_t>(files.size()), 2);
  append(archive, static_cast<uint32_t>(directory.size()), 4);
  append(archive, begin, 4);
  append(archive, 0, 2);
  return archive;
}

std::string three_mf_file() {
  return archive_of(
      {{"[Content_Types].xml", content_types}, {"_rels/.rels", relationships}, {"3D/3dmodel.model", three_mf}});
}

struct File {
  std::string name, content, refused;  // as what it is, in a build without assimp
  Vec3f size{};                        // metres, y up
};

class ImportAssimp : public testing::TestWithParam<File> {};

TEST_P(ImportAssimp, ReadsItWhereItIsBuiltIn) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write(GetParam().name, GetParam().content);
  Report report;
  const auto scene = load_scene(path.string(), {}, report);
#ifdef LIGHTWELL_ASSIMP
  ASSERT_TRUE(scene) << scene.error().message();
  constexpr float rounding = 1e-5f;  // of a unit and a turn in floats
  EXPECT_LE(length(scene->bounds().size() - GetParam().size), rounding)
      << testing::PrintToString(scene->bounds().size().e);
  // Half of the file is no file, and is refused like any other.
  const std::filesystem::path half =
      folder.write("half" + path.extension().string(), GetParam().content.substr(0, GetParam().content.size() / 2));
  const auto broken = load_scene(half.string(), {}, report);
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message().find("(assimp: "), std::string::npos) << broken.error().message();
#else
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().reason, "cannot be read: it is " + GetParam().refused);
#endif
}

INSTANTIATE_TEST_SUITE_P(Formats, ImportAssimp,
                         testing::Values(File{"triangle.dae", collada, "an XML file", {{3, 2, 0}}},
                                         File{"triangle.fbx", fbx, "an FBX file; export it as glTF", {{3, 2, 0}}},
                                         File{"triangle.3mf", three_mf_file(), "a ZIP archive", {{0.03f, 0, 0.02f}}}),
                         [](const auto& file) { return file.param.name.substr(9); });

}  // namespace
}  // namespace lightwell
