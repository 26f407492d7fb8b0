// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "lightwell/gltf/document.h"

using namespace lightwell;

namespace {

/// A folder that does not exist, so that no input can read a file.
const std::filesystem::path no_folder = "/nonexistent";

void require(bool condition) {
  if (!condition) std::abort();
}

void read_primitives(const Document& document, Report& report) {
  size_t corners = 0;
  const Json& meshes = member(document.json, "meshes");
  for (size_t m = 0; m < meshes.size(); m++)
    for (size_t p = 0; p < meshes[m]["primitives"].size(); p++) {
      const auto mesh = read_primitive(document, static_cast<int>(m), static_cast<int>(p), report);
      if (!mesh) continue;
      corners += mesh->faces.size() * 3;
      for (const Face& face : mesh->faces)
        for (const uint32_t corner : face) require(corner < mesh->positions.size());
      if (corners > size_t(1) << 20) return;  // many primitives may share one large accessor
    }
}

}  // namespace

/// Whatever can be read can be written, and reads the same again.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Report report;
  const auto document = read_document({data, size}, no_folder, report);
  if (!document) return 0;
  read_primitives(*document, report);
  for (size_t i = 0; i < member(document->json, "images").size(); i++) (void)read_image(*document, static_cast<int>(i));
  const auto written = write_glb(*document, report);
  require(written.has_value());
  Report second;
  const auto again = read_document(*written, no_folder, second);
  require(again.has_value());
  require(member(again->json, "meshes") == member(document->json, "meshes"));
  return 0;
}
