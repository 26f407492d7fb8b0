// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_assimp.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <exception>

#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/scene_builder.h"

namespace lightwell {
namespace {

/// The file as assimp writes it in glTF: its own names for textures, triangles, normals where there were none.
Result<std::vector<uint8_t>> converted(Bytes file, const std::string& ending) {
  constexpr unsigned steps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
                             aiProcess_GenSmoothNormals | aiProcess_GlobalScale | aiProcess_ValidateDataStructure;
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(file.data(), file.size(), steps, ending.c_str());
  if (scene == nullptr) return fail("assimp", std::string(importer.GetErrorString()).substr(0, 200));
  Assimp::Exporter exporter;
  const aiExportDataBlob* glb = exporter.ExportToBlob(scene, "glb2");
  if (glb == nullptr) return fail("assimp", std::string(exporter.GetErrorString()).substr(0, 200));
  const auto* bytes = static_cast<const uint8_t*>(glb->data);
  return std::vector<uint8_t>(bytes, bytes + glb->size);
}

/// Textures by the names of files beside the scene: other systems' separators and folders mean nothing here.
void take_names_of_files(Json& document) {
  for (Json& image : document["images"])
    if (const std::string uri = text(image, "uri"); !uri.empty() && !uri.starts_with("data:"))
      image["uri"] = as_uri(uri.substr(uri.find_last_of("/\\") + 1));
}

}  // namespace

Result<Document> assimp_document(Bytes file, const std::filesystem::path& path, Report& report) {
  const std::string ending = path.extension().string();
  try {
    LW_TRY(glb, converted(file, ending.empty() ? ending : ending.substr(1)));
    LW_TRY(document, read_document(glb, path.parent_path(), report));
    if (document.json.contains("images")) take_names_of_files(document.json);
    if (ending == ".3mf" || ending == ".3MF") {
      Orientation of_printers;
      of_printers.up.axis = 2;
      of_printers.unit = 0.001f;
      reorient(document, of_printers);
      report.warn("read by assimp, in millimetres with z up, as 3MF is unless it says otherwise");
    } else {
      report.warn("read by assimp");
    }
    return document;
  } catch (const std::exception& exception) {
    return fail("assimp", exception.what());
  }
}

}  // namespace lightwell
