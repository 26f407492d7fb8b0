// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_obj_loader.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lightwell/scene/scene_builder.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// An image of a material: its file, empty for none, and where it lies.
struct ObjTexture {
  std::string file;
  TexturePlacement placement;
};

/// What is read of a material of an MTL file: a tenth of what the library keeps of one, as files have a million.
struct ObjMaterial {
  std::string name;
  Vec3f color{}, emission{};
  float opacity = 1;
  ObjTexture color_map, emission_map;
  std::string opacity_map;  ///< name of a file; empty: none. It lies as the colour's.
  uint32_t unread = 0;      ///< which visible properties are left out
  uint32_t folder = 0;      ///< of its MTL file
};

/// Reads the MTL files that an OBJ file names, from the OBJ file's folder and below. Files that cannot be read cause a
/// warning.
class ObjMaterialReader : public tinyobj::MaterialReader {
 public:
  ObjMaterialReader(std::filesystem::path folder, ImageLimit limit, Report& report)
      : folder_(std::move(folder)), limit_(limit), report_(report) {}

  /// Called by the library with the rest of an mtllib line. Only the numbers of the materials by their names are given
  /// to the library.
  bool operator()(const std::string& names, std::vector<tinyobj::material_t>*, std::map<std::string, int>* indices,
                  std::string* warning, std::string* error) override;
  /// The glTF material that stands for a material of an MTL file; its textures are looked for beside that file.
  int add_to(SceneBuilder& scene, size_t index, bool has_texcoords) const;

 private:
  bool read(const std::string& name, std::map<std::string, int>& indices);
  void read_some(const std::string& text, std::map<std::string, int>& indices);
  std::string texture_uri(const std::string& name, const ObjMaterial& material) const;
  Json texture(SceneBuilder& scene, const ObjTexture& texture, const ObjMaterial& material) const;
  void add_opacity(SceneBuilder& scene, const ObjMaterial& material, Json& json) const;

  std::filesystem::path folder_;
  ImageLimit limit_;
  Report& report_;
  std::vector<ObjMaterial> materials_;
  std::vector<std::filesystem::path> folders_;  ///< of the MTL files, relative to the OBJ's
};

}  // namespace lightwell
