// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/gltf/json.h"
#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// A glTF 2.0 document: its JSON, and the bytes of its buffers.
struct Document {
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::vector<std::vector<uint8_t>> buffers;  ///< as many as json["buffers"]
  std::filesystem::path folder;               ///< of the file: where its images lie
};

/// True when bytes look like a GLB or glTF JSON file.
bool is_gltf(Bytes bytes);

/// Reads the document in `bytes` (GLB or JSON) with the buffers it refers to: the GLB's, data URIs, and files below
/// `folder`. The structure is checked (indices in range, sizes within buffers, nodes a forest), so that later reads
/// need not.
///
/// The document is given back in plain form: what Draco, meshopt and sparse accessors hold of the primitives stands in
/// buffers of its own, and those extensions are gone from the JSON. Extensions that are not on the list of
/// extensions.h are removed with a warning. Names, extras and all else are kept as they are.
Result<Document> read_document(Bytes bytes, const std::filesystem::path& folder, Report& report);

/// How a primitive's vertices are joined (glTF's numbers).
enum class PrimitiveMode { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };
PrimitiveMode primitive_mode(const Json& primitive);
/// True for triangles, strips and fans: what read_primitive reads.
bool has_triangles(const Json& primitive);

/// The triangles of a primitive (also of strips and fans), quantised and normalised attributes turned into floats.
/// Fails for lines and points, for numbers that are not finite and for indices outside the vertices. A primitive with
/// more vertices than corners gets only the vertices it uses, so that many primitives may share one large accessor.
Result<Mesh> read_primitive(const Document& document, int mesh, int primitive, Report& report);

/// The stored bytes of an image: a buffer view, a data URI or a file below the document's folder.
Result<std::vector<uint8_t>> read_image(const Document& document, int image);

/// Builds up a document: each function appends to its one buffer and its JSON and returns the new element's index.
class DocumentBuilder {
 public:
  explicit DocumentBuilder(Document& document) : document_(document) {}

  /// Appends an element to a top-level array of the JSON ("nodes", "materials", ...).
  int add(const char* array, Json element);
  /// `target` is glTF's bufferView.target, 0 for none.
  int buffer_view(Bytes bytes, int target = 0);
  int accessor(const std::vector<Vec3f>& values, bool with_bounds);
  int accessor(const std::vector<Vec2f>& values);
  int colors(const std::vector<Vec4f>& values);  ///< as normalized 16-bit numbers: linear bytes would band in the dark
  int indices(const std::vector<Face>& faces, size_t vertices);
  /// The attributes and indices of a mesh as the JSON of a primitive, without material.
  Json primitive(const Mesh& mesh);

 private:
  int accessor(Bytes bytes, int component_type, const char* type, size_t count, int target);

  Document& document_;
};

/// Removes accessors, buffer views and buffers that nothing in the JSON refers to any more, with their bytes, and
/// numbers the others anew wherever references.h knows of a reference.
void drop_unused(Document& document);

/// Puts the arrays of meshes that have buffer views of their own into a few that they share: one for each size of
/// element. JSON says as much about a view as about an array. The views of before stay, unused: single_buffer drops
/// them.
void share_buffer_views(Document& document);

/// The document with at most one buffer and every image inside it. An image that cannot be read becomes a white pixel
/// and a warning.
Document single_buffer(Document document, Report& report);

/// The two chunks of a GLB, not padded yet.
struct GlbParts {
  std::string json;
  std::vector<uint8_t> bin;
};
/// Of a document with at most one buffer, as single_buffer gives it.
GlbParts glb_parts(const Document& document);

/// The document as a GLB, its buffers made one and its images put inside. Fails beyond 4 GiB.
Result<std::vector<uint8_t>> write_glb(Document document, Report& report);

}  // namespace lightwell
