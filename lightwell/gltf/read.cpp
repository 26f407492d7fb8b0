// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lightwell/base/glb.h"
#include "lightwell/gltf/check.h"
#include "lightwell/gltf/document.h"
#include "lightwell/gltf/expand.h"
#include "lightwell/gltf/extensions.h"
#include "lightwell/gltf/parsed_document.h"
#include "lightwell/gltf/resource.h"

namespace lightwell {
namespace {

constexpr size_t glb_header_bytes = 12;

/// The limit on the sum of all buffers, which is also the most that a GLB can hold.
constexpr double max_bytes = 0x1p32;

/// The two chunks of a GLB that glTF defines.
struct Chunks {
  Bytes json;
  Bytes bin;
  bool has_bin = false;
};

bool is_glb(Bytes bytes) { return ByteReader(bytes).u32() == glb_magic; }

Result<Bytes> next_chunk(ByteReader& reader, uint32_t& type, const std::string& name) {
  const uint64_t place = glb_header_bytes + reader.position();
  const uint32_t length = reader.u32();
  type = reader.u32();
  const Bytes chunk = reader.take(length);
  if (!reader.ok()) return fail({"", name, "is longer than the file", ErrorKind::bad_input, place});
  return chunk;
}

/// The part of the file that holds chunks, limited by the length in the GLB header. Bytes after it are ignored.
Result<Bytes> glb_body(Bytes bytes, Report& report) {
  ByteReader reader(bytes);
  reader.u32();
  const uint32_t version = reader.u32(), length = reader.u32();
  if (!reader.ok()) return fail("GLB header", "the file ends too early");
  if (version != 2)
    return fail({"", "GLB header", "version " + std::to_string(version) + " is not supported, only 2",
                 ErrorKind::unsupported, 4});
  if (length > bytes.size())
    return fail("GLB header",
                "announces " + std::to_string(length) + " bytes, the file has " + std::to_string(bytes.size()));
  if (length < glb_header_bytes) return fail("GLB header", "announces less than its own length");
  if (length < bytes.size()) report.warn("bytes after the end of the GLB are ignored");
  return bytes.subspan(glb_header_bytes, length - glb_header_bytes);
}

Result<Chunks> split_glb(Bytes bytes, Report& report) {
  LW_TRY(body, glb_body(bytes, report));
  ByteReader reader(body);
  Chunks chunks;
  for (int i = 0; reader.remaining() > 0; i++) {
    const std::string name = element_name("chunks", static_cast<size_t>(i));
    uint32_t type = 0;
    LW_TRY(chunk, next_chunk(reader, type, name));
    if (chunk.size() % 4 != 0) report.warn("GLB: the length of a chunk is not a multiple of 4");
    if ((type == glb_json_chunk) != (i == 0))
      return fail(name, i == 0 ? "is not of type JSON" : "is a second chunk of type JSON");
    if (type == glb_bin_chunk && i != 1) return fail(name, "the chunk of type BIN is not the second one");
    if (type == glb_json_chunk) chunks.json = chunk;
    if (type == glb_bin_chunk) chunks.bin = chunk;
    chunks.has_bin |= type == glb_bin_chunk;
  }
  if (chunks.json.empty()) return fail("GLB", "has no JSON");
  return chunks;
}

/// True for a fallback buffer, which need not be read since all of its views are compressed.
bool is_fallback(const Json& buffer) {
  return boolean(extension(buffer, "EXT_meshopt_compression"), "fallback", false) ||
         boolean(extension(buffer, "KHR_meshopt_compression"), "fallback", false);
}

Result<std::vector<uint8_t>> read_buffer(const Document& document, size_t index, const Chunks& chunks) {
  const Json& buffer = document.json["buffers"][index];
  if (is_fallback(buffer)) return std::vector<uint8_t>();
  if (member(buffer, "uri").is_string()) return read_uri(text(buffer, "uri"), document.folder);
  if (index == 0 && chunks.has_bin) return std::vector<uint8_t>(chunks.bin.begin(), chunks.bin.end());
  return std::vector<uint8_t>();  // an unmarked fallback buffer; see check_stand_ins
}

Result<void> read_buffers(Document& document, const Chunks& chunks) {
  double total = 0;
  for (size_t i = 0; i < member(document.json, "buffers").size(); i++) {
    Json& json = document.json["buffers"][i];
    const std::string name = element_name("buffers", i);
    auto bytes = read_buffer(document, i, chunks);
    if (!bytes) return fail(in_element(bytes.error(), name));
    const auto length = static_cast<size_t>(number(json, "byteLength", 0));
    if (!bytes->empty() && bytes->size() < length)
      return fail(name, "byteLength is " + std::to_string(length) + ", but it holds " + std::to_string(bytes->size()) +
                            " bytes");
    total += static_cast<double>(std::max(bytes->size(), length));
    if (total > max_bytes) return fail(ErrorKind::limit, "buffers", "hold more than 4 GiB");
    if (bytes->size() > length) {
      bytes->resize(length);
      bytes->shrink_to_fit();  // a file may refer to a large one many times, for a byte each
    }
    json.erase("uri");
    document.buffers.push_back(std::move(*bytes));
  }
  return {};
}

/// Expands compressed and sparse data. The budget allows for the largest ratio of meshopt, 64, and is ample for every
/// small file.
Result<void> expand(Document& document, size_t file_bytes) {
  double bytes = static_cast<double>(file_bytes);
  for (const auto& buffer : document.buffers) bytes += static_cast<double>(buffer.size());
  Budget budget(std::min(max_bytes, 0x1p26 + 64 * bytes));
  LW_CHECK(expand_meshopt(document, budget));
  LW_CHECK(expand_draco(document, budget));
  return expand_sparse(document, budget);
}

/// Fails when a view still uses a buffer without bytes after all views have been decoded.
Result<void> check_stand_ins(const Document& document) {
  const Json& views = member(document.json, "bufferViews");
  for (size_t i = 0; i < views.size(); i++) {
    const auto buffer = static_cast<size_t>(index_of(views[i], "buffer"));
    if (document.buffers[buffer].empty())
      return fail(element_name("bufferViews", i),
                  element_name("buffers", buffer) + " has neither a URI nor a BIN chunk");
  }
  return {};
}

Result<Document> read_chunks(Json json, const Chunks& chunks, size_t file_bytes, const std::filesystem::path& folder,
                             Report& report) {
  LW_CHECK(check_version(json));
  LW_CHECK(check_required_extensions(json));
  drop_unknown_extensions(json, report);
  LW_CHECK(check_document(json, report));
  Document document{std::move(json), {}, folder};
  LW_CHECK(read_buffers(document, chunks));
  LW_CHECK(expand(document, file_bytes));
  drop_unused(document);
  LW_CHECK(check_stand_ins(document));
  return document;
}

}  // namespace

bool is_gltf(Bytes bytes) {
  if (is_glb(bytes)) return true;
  constexpr uint8_t mark[] = {0xef, 0xbb, 0xbf};
  if (bytes.size() >= 3 && std::equal(mark, mark + 3, bytes.begin())) bytes = bytes.subspan(3);
  const auto first = std::find_if(bytes.begin(), bytes.end(), [](uint8_t c) { return c > ' '; });
  return first != bytes.end() && *first == '{';
}

Result<Document> read_document(Bytes bytes, const std::filesystem::path& folder, Report& report) {
  Chunks chunks{bytes, {}, false};
  if (is_glb(bytes)) {
    LW_TRY(split, split_glb(bytes, report));
    chunks = split;
  }
  LW_TRY(json, parse_json(chunks.json, static_cast<uint64_t>(chunks.json.data() - bytes.data())));
  return read_chunks(std::move(json), chunks, bytes.size(), folder, report);
}

Result<Document> read_document(Json json, Bytes bin, Report& report) {
  return read_chunks(std::move(json), {{}, bin, !bin.empty()}, bin.size(), {}, report);
}

}  // namespace lightwell
