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

/// Reads the MTL files that an OBJ file names, from the OBJ file's folder and below. Files that cannot be read cause a
/// warning.
class ObjMaterialReader : public tinyobj::MaterialReader {
 public:
  ObjMaterialReader(std::filesystem::path folder, ImageLimit limit, Report& report)
      : folder_(std::move(folder)), limit_(limit), report_(report) {}

  /// Called by the library with the rest of an mtllib line.
  bool operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* indices, std::string* warning, std::string* error) override;
  /// The glTF material that stands for a material of an MTL file; its textures are looked for beside that file.
  int add_to(SceneBuilder& scene, const tinyobj::material_t& material, size_t index, bool has_texcoords) const;

 private:
  bool read(const std::string& name, std::vector<tinyobj::material_t>* materials, std::map<std::string, int>* indices);
  std::string texture_uri(const std::string& name, size_t material) const;
  Json texture(SceneBuilder& scene, const std::string& name, size_t material) const;
  void add_opacity(SceneBuilder& scene, const tinyobj::material_t& material, size_t index, Json& json) const;

  std::filesystem::path folder_;
  ImageLimit limit_;
  Report& report_;
  std::vector<std::filesystem::path> folder_of_material_;  ///< of its MTL file, relative to the OBJ's
};

}  // namespace lightwell
