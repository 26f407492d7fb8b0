// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/write_ply.h"

#include <string>

#include "lightwell/base/bytes.h"

namespace lightwell {
namespace {

void append(ByteWriter& writer, const Vec3f& v) {
  for (const float x : v.e) writer.f32(x);
}

}  // namespace

std::vector<uint8_t> write_ply(const Mesh& mesh, const Vec3d& origin) {
  const bool far = origin != Vec3d{};
  const std::string type = far ? "double" : "float";
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size());
  for (const char* axis : {"x", "y", "z"}) header += "\nproperty " + type + " " + axis;
  if (!mesh.normals.empty()) header += "\nproperty float nx\nproperty float ny\nproperty float nz";
  header += "\nelement face " + std::to_string(mesh.faces.size());
  header += "\nproperty list uchar uint vertex_indices\nend_header\n";

  ByteWriter writer;
  writer.append(as_bytes(header));
  for (size_t i = 0; i < mesh.positions.size(); i++) {
    if (far)
      for (const double x : (mesh.positions[i].cast<double>() + origin).e) writer.f64(x);
    else
      append(writer, mesh.positions[i]);
    if (!mesh.normals.empty()) append(writer, mesh.normals[i]);
  }
  for (const Face& face : mesh.faces) {
    writer.u8(3);
    for (const uint32_t corner : face) writer.u32(corner);
  }
  return writer.release();
}

}  // namespace lightwell
