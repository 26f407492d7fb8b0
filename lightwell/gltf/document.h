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
  std::filesystem::path folder;               ///< of the file; image URIs are relative to it
};

/// True when bytes look like a GLB or glTF JSON file.
bool is_gltf(Bytes bytes);

/// Reads a document from `bytes` (GLB or JSON) with the buffers it refers to: the GLB's, data URIs, and files below
/// `folder`. The structure is checked (indices in range, sizes within buffers, nodes in a forest), so that later reads
/// need not.
///
/// The result is in plain form: Draco and meshopt data and the sparse accessors of primitives are expanded into buffers
/// of their own, and those extensions are removed from the JSON. Extensions that extensions.cpp does not list are
/// removed with a warning. Everything else is kept, names and extras included.
Result<Document> read_document(Bytes bytes, const std::filesystem::path& folder, Report& report);

struct Pose;

/// A primitive's topology, with glTF's numbers.
enum class PrimitiveMode { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };
PrimitiveMode primitive_mode(const Json& primitive);
/// True for triangles, strips and fans, which read_primitive can read.
bool has_triangles(const Json& primitive);

/// The triangles of a primitive (a list, strip or fan), with quantised and normalised attributes converted to floats.
/// Fails for lines and points, for positions that are not finite and for indices out of range. Of a primitive with more
/// vertices than corners only the used vertices are read, so that many primitives may share one large accessor.
/// Vertices are in the given pose.
Result<Mesh> read_primitive(const Document& document, int mesh, int primitive, const Pose& pose, Report& report);
/// The same in the pose at rest.
Result<Mesh> read_primitive(const Document& document, int mesh, int primitive, Report& report);

/// The stored bytes of an image: a buffer view, a data URI or a file below the document's folder.
Result<std::vector<uint8_t>> read_image(const Document& document, int image);

/// Appends elements to the JSON of a document and their data to its last buffer. Functions return the index of the new
/// element.
class DocumentBuilder {
 public:
  explicit DocumentBuilder(Document& document) : document_(document) {}

  /// Appends an element to a top-level array of the JSON ("nodes", "materials", ...).
  int add(const char* array, Json element);
  /// `target` is glTF's bufferView.target, 0 for none.
  int buffer_view(Bytes bytes, int target = 0);
  int accessor(const std::vector<Vec3f>& values, bool with_bounds);
  int accessor(const std::vector<Vec2f>& values);
  int colors(const std::vector<Vec4f>& values);  ///< as normalized 16-bit numbers: 8-bit ones would band in the dark
  int indices(const std::vector<Face>& faces, size_t vertices);
  /// Appends the arrays of a mesh's vertices and returns the JSON of a primitive's attributes.
  Json vertices(const Mesh& mesh);
  /// Appends the arrays of a mesh and returns the JSON of a primitive with them, without material.
  Json primitive(const Mesh& mesh);

 private:
  int accessor(Bytes bytes, int component_type, const char* type, size_t count, int target);

  Document& document_;
};

/// Removes the accessors, buffer views and buffers that nothing in the JSON refers to, with their bytes, and renumbers
/// all references that references.h knows.
void drop_unused(Document& document);

/// Removes the images that no texture refers to, and renumbers the others. Their data goes with drop_unused.
void drop_unused_images(Document& document);

/// Merges the buffer views of mesh arrays into one for each role and element size, since a view takes as much JSON as
/// an array. The old views stay, unused, until single_buffer drops them.
void share_buffer_views(Document& document);

/// The document with all data, images included, in at most one buffer. An image that cannot be read is replaced by a
/// white pixel, with a warning.
Document single_buffer(Document document, Report& report);

/// The document as a GLB, with its buffers merged and its images embedded. Fails above 4 GiB.
Result<std::vector<uint8_t>> write_glb(Document document, Report& report);

}  // namespace lightwell
