// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/gltf/document.h"

namespace lightwell {

inline std::vector<uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// The bytes of an array of numbers.
template <typename T>
std::vector<uint8_t> raw(const std::vector<T>& values) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(values.data());
  return {bytes, bytes + values.size() * sizeof(T)};
}

/// Two triangles of the unit square in z = 0, facing +z.
inline Mesh square() {
  Mesh mesh;
  mesh.positions = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A document that shows `mesh` by one node.
inline Document document_of(const Mesh& mesh) {
  Document document;
  DocumentBuilder builder(document);
  const Json primitive = builder.primitive(mesh);
  builder.add("meshes", {{"primitives", Json::array({primitive})}});
  builder.add("nodes", {{"mesh", 0}});
  builder.add("scenes", {{"nodes", {0}}});
  document.json["scene"] = 0;
  return document;
}

/// A GLB of JSON and a binary chunk, without any check.
inline std::vector<uint8_t> glb(const Json& json, const std::vector<uint8_t>& bin) {
  const std::string text = json.dump();
  const size_t json_size = (text.size() + 3) / 4 * 4, bin_size = (bin.size() + 3) / 4 * 4;
  ByteWriter writer;
  for (const uint32_t word : {0x46546c67u, 2u, static_cast<uint32_t>(28 + json_size + bin_size)}) writer.u32(word);
  writer.u32(static_cast<uint32_t>(json_size));
  writer.u32(0x4e4f534a);
  writer.append(as_bytes(text));
  writer.align(4, ' ');
  writer.u32(static_cast<uint32_t>(bin_size));
  writer.u32(0x004e4942);
  writer.append(bin);
  writer.align(4);
  return writer.release();
}

/// Reads bytes as a document without a folder.
inline Result<Document> read_bytes(const std::vector<uint8_t>& bytes) {
  Report report;
  return read_document(bytes, "/nonexistent", report);
}

/// Reads a document after it has been written as a GLB, as a stranger would.
inline Result<Document> read_again(const Document& document) {
  return read_bytes(glb(document.json, document.buffers.empty() ? std::vector<uint8_t>() : document.buffers[0]));
}

/// Writes, reads and takes the first primitive.
inline Result<Mesh> first_mesh(const Document& document) {
  Report report;
  LW_TRY(again, read_again(document));
  return read_primitive(again, 0, 0, report);
}

}  // namespace lightwell
