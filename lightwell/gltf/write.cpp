// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lightwell/base/assert.h"
#include "lightwell/base/glb.h"
#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/document.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

/// The media type of an image, from its first bytes; empty when neither glTF nor an extension knows it.
std::string media_type(Bytes bytes) {
  if (const auto format = image_format(bytes)) return std::string(mime_type(*format));
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<size_t>(bytes.size(), 12));
  if (head.starts_with("\xabKTX 20")) return "image/ktx2";
  if (head.size() == 12 && head.substr(4) == "ftypavif") return "image/avif";
  return "";
}

/// Embeds an external image in a buffer of its own.
void embed_image(Document& document, size_t index, Report& report) {
  auto bytes = read_image(document, static_cast<int>(index));
  std::string type = bytes ? media_type(*bytes) : "";
  if (type.empty()) {
    report.warn((bytes ? element_name("images", index) + ": is of no known type" : bytes.error().message()) +
                "; a white pixel stands for it");
    bytes = write_png(Image{1, 1, 1, {255}});
    type = "image/png";
  }
  const int view = append_buffer_view(document, std::move(*bytes), 0, 0);
  Json& image = document.json["images"][index];
  image.erase("uri");
  image["mimeType"] = type;
  image["bufferView"] = view;
}

/// A part of a buffer covered by one view or by overlapping ones, and its new place.
struct Piece {
  size_t begin = 0;
  size_t end = 0;
  size_t moved_to = 0;
};

struct Range {
  size_t begin = 0;
  size_t end = 0;
  Json* view = nullptr;
};

/// Appends the used pieces of `source` to `merged` and updates their views. A piece keeps its offset modulo 4, so that
/// aligned data stays aligned.
void merge_buffer(const std::vector<uint8_t>& source, std::vector<Range>& ranges, std::vector<uint8_t>& merged) {
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
  Piece piece;
  const auto copy_piece = [&](size_t from) {
    merged.insert(merged.end(), source.begin() + static_cast<ptrdiff_t>(from),
                  source.begin() + static_cast<ptrdiff_t>(piece.end));
  };
  for (const Range& range : ranges) {
    if (range.begin >= piece.end) {
      merged.resize((merged.size() + 3) / 4 * 4 + range.begin % 4);
      piece = {range.begin, range.end, merged.size()};
      copy_piece(range.begin);
    } else if (range.end > piece.end) {
      const size_t from = piece.end;
      piece.end = range.end;
      copy_piece(from);
    }
    (*range.view)["buffer"] = 0;
    (*range.view)["byteOffset"] = piece.moved_to + (range.begin - piece.begin);
  }
}

void merge_buffers(Document& document) {
  if (document.buffers.empty()) return;
  std::vector<std::vector<Range>> ranges(document.buffers.size());
  for (Json& view : document.json["bufferViews"]) {
    const auto begin = static_cast<size_t>(number(view, "byteOffset", 0));
    const auto length = static_cast<size_t>(number(view, "byteLength", 0));
    const auto buffer = static_cast<size_t>(index_of(view, "buffer"));
    LW_ASSERT(begin + length <= document.buffers[buffer].size());
    ranges[buffer].push_back({begin, begin + length, &view});
  }
  std::vector<uint8_t> merged;
  for (size_t i = 0; i < ranges.size(); i++) merge_buffer(document.buffers[i], ranges[i], merged);
  Json& buffers = document.json["buffers"];
  buffers.erase(buffers.begin() + 1, buffers.end());
  buffers[0]["byteLength"] = merged.size();
  document.buffers.resize(1);
  document.buffers[0] = std::move(merged);
}

}  // namespace

Document single_buffer(Document document, Report& report) {
  const size_t images = member(document.json, "images").size();
  for (size_t i = 0; i < images; i++)
    if (!document.json["images"][i].contains("bufferView")) embed_image(document, i, report);
  drop_unused(document);
  merge_buffers(document);
  return document;
}

Result<std::vector<uint8_t>> write_glb(Document document, Report& report) {
  document = single_buffer(std::move(document), report);
  const std::string json = json_text(document.json);
  const Bytes bin = document.buffers.empty() ? Bytes() : Bytes(document.buffers[0]);
  const auto padded = [](size_t size) { return (size + 3) / 4 * 4; };
  const size_t bin_size = bin.empty() ? 0 : 8 + padded(bin.size());
  const size_t size = 20 + padded(json.size()) + bin_size;
  if (size > std::numeric_limits<uint32_t>::max()) return fail(ErrorKind::limit, "GLB", "would be larger than 4 GiB");

  ByteWriter writer;
  writer.u32(glb_magic);
  writer.u32(2);
  writer.u32(static_cast<uint32_t>(size));
  writer.u32(static_cast<uint32_t>(padded(json.size())));
  writer.u32(glb_json_chunk);
  writer.append(as_bytes(json));
  writer.align(4, ' ');
  if (bin.empty()) return writer.release();
  writer.u32(static_cast<uint32_t>(padded(bin.size())));
  writer.u32(glb_bin_chunk);
  writer.append(bin);
  writer.align(4);
  return writer.release();
}

}  // namespace lightwell
