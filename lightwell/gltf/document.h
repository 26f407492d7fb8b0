// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// JSON that keeps the order of its keys, as a file that is written again should.
using Json = nlohmann::ordered_json;

/// A glTF 2.0 document: its JSON as it stands in the file, and the bytes of its buffers.
struct Document {
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::vector<std::vector<uint8_t>> buffers;  ///< as many as json["buffers"]
  std::filesystem::path folder;               ///< of the file: where its images lie
};

/// True when bytes look like a GLB or glTF JSON file.
bool is_gltf(Bytes bytes);

/// Reads the document in `bytes` (GLB or JSON) with the buffers it refers to: the GLB's, data URIs, and files below `folder`.
/// The structure is checked (indices in range, sizes within buffers, nodes a forest), so that later reads need not.
Result<Document> read_document(Bytes bytes, const std::filesystem::path& folder, Report& report);

/// The triangles of a primitive (also of strips and fans): accessors resolved through Draco, meshopt, sparse values and
/// quantisation. Fails for lines and points; see primitive_mode.
Result<Mesh> read_primitive(const Document& document, int mesh, int primitive, Report& report);

/// The stored bytes of an image: a buffer view, a data URI or a file below the document's folder.
Result<std::vector<uint8_t>> read_image(const Document& document, int image);

/// Builds up a document: each function appends to its one buffer and its JSON and returns the new element's index.
class DocumentBuilder {
 public:
  explicit DocumentBuilder(Document& document) : document_(document) {}

  /// `target` is glTF's bufferView.target, 0 for none.
  int buffer_view(Bytes bytes, int target = 0);
  int accessor(const std::vector<Vec3f>& values, bool with_bounds);
  int accessor(const std::vector<Vec2f>& values);
  int colors(const std::vector<Vec4f>& values);  ///< as normalized bytes
  int indices(const std::vector<Face>& faces, size_t vertices);
  /// The attributes and indices of a mesh as the JSON of a primitive, without material.
  Json primitive(const Mesh& mesh);

 private:
  Document& document_;
};

/// The document as a GLB: one buffer, images inside; `chunks` (type, bytes) follow the BIN chunk.
std::vector<uint8_t> write_glb(const Document& document);

}  // namespace lightwell
