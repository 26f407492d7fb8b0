// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "lightwell/scene/import_draco.h"
#include "lightwell/scene/import_obj.h"
#include "lightwell/scene/obj_text.h"
#include "lightwell/scene/ply.h"
#include "lightwell/scene/stl.h"

using namespace lightwell;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check(const Mesh& mesh) {
  require(mesh.normals.size() == mesh.positions.size());
  for (const Face& face : mesh.faces)
    for (const uint32_t corner : face) require(corner < mesh.positions.size());
}

}  // namespace

/// PLY, OBJ, STL and bare Draco files: any bytes give a mesh whose indices are in range, or an error of one line.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const Bytes bytes(data, size);
  Report report;
  if (is_ply(bytes)) {
    const auto content = read_ply(bytes, report);
    if (content)
      for (const PlyPart& part : content->parts) check(part.mesh);
    require(content || content.error().message().find('\n') == std::string::npos);
  } else if (is_draco(bytes)) {
    const auto document = draco_document(bytes);
    require(document || document.error().message().find('\n') == std::string::npos);
  } else if (is_stl(bytes)) {
    const auto document = stl_document(bytes, report);
    require(document || document.error().message().find('\n') == std::string::npos);
  } else if (is_obj(bytes)) {
    const auto document = obj_document(bytes, "/nonexistent", report);
    require(document || document.error().message().find('\n') == std::string::npos);
  }
  return 0;
}
