// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/parts_file.h"

#include "lightwell/base/gzip.h"
#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

Json to_json(const PartsFile::Merged& merged) {
  Json nodes = Json::array(), primitives = Json::array();
  for (const PartsFile::Part& part : merged.parts) {
    nodes.push_back(part.node);
    primitives.push_back(part.primitive);
  }
  return {{"nodes", nodes}, {"primitives", primitives}, {"table", merged.table}};
}

Result<std::vector<uint32_t>> read_whole_numbers(MemberReader& reader, const char* key) {
  constexpr int64_t most = 0x7fffffff;
  std::vector<uint32_t> numbers;
  for (const Json& value : reader.array(key)) {
    const int64_t number = whole_number(value);
    if (number < 0 || number > most) reader.refuse(key, "has what is no whole number");
    numbers.push_back(static_cast<uint32_t>(number));
  }
  return reader.finish(std::move(numbers));
}

Result<PartsFile::Merged> read_merged(const Json& json, const std::string& name) {
  MemberReader reader(json, name);
  LW_TRY(nodes, read_whole_numbers(reader, "nodes"));
  LW_TRY(primitives, read_whole_numbers(reader, "primitives"));
  LW_TRY(table, read_whole_numbers(reader, "table"));
  if (nodes.size() != primitives.size()) return fail(name + ".primitives", "are not as many as the nodes");
  PartsFile::Merged merged;
  for (size_t i = 0; i < nodes.size(); i++) merged.parts.push_back({nodes[i], primitives[i]});
  merged.table = std::move(table);
  return merged;
}

}  // namespace

Json to_json(const PartsDescription& description) {
  return {{"stream", description.stream},
          {"nodes", description.nodes},
          {"meshes", description.meshes},
          {"materials", description.materials}};
}

Result<std::optional<PartsDescription>> read_parts_description(const Json& json) {
  const Json& said = extension(json, parts_extension);
  if (said.is_null()) return std::nullopt;
  MemberReader reader(said, parts_extension);
  const PartsDescription description{reader.whole("stream"), reader.whole("nodes"), reader.whole("meshes"),
                                     reader.whole("materials")};
  if (member(json, "nodes").size() != size_t(description.nodes) + 1)
    reader.refuse("nodes", "are not all nodes but the last");
  if (member(json, "meshes").size() != size_t(description.meshes) + 1)
    reader.refuse("meshes", "are not all meshes but the last");
  if (member(json, "materials").size() != description.materials) reader.refuse("materials", "are not all materials");
  return reader.finish(std::optional(description));
}

std::vector<uint8_t> write_parts_file(const PartsFile& file, PartsParameters& parameters) {
  Json json = {{"nodes", file.nodes},
               {"meshes", file.meshes},
               {"materials", file.materials},
               {"roots", file.roots},
               {"shown", file.shown}};
  for (const PartsFile::Merged& merged : file.merged) json["merged"].push_back(to_json(merged));
  const std::string text = json_text(json);
  std::vector<uint8_t> packed = gzip(as_bytes(text));
  parameters = {static_cast<uint32_t>(packed.size()), static_cast<uint32_t>(text.size())};
  if (parameters.possible()) return packed;
  packed = gzip(as_bytes(text), false);
  parameters.bytes = static_cast<uint32_t>(packed.size());
  return packed;
}

Result<PartsFile> read_parts_file(Bytes bytes, uint32_t inflated) {
  LW_TRY(text, gunzip(bytes, inflated));
  if (text.size() != inflated) return fail("parts", "is not of the size that its stream states");
  LW_TRY(json, parse_json(text));
  MemberReader reader(json, "parts");
  PartsFile file;
  file.nodes = reader.array("nodes");
  file.meshes = reader.array("meshes");
  file.materials = reader.array("materials");
  file.roots = reader.array("roots");
  file.shown = reader.array("shown");
  const Json& merged = reader.array("merged");
  LW_CHECK(reader.finish(true));
  for (size_t i = 0; i < merged.size(); i++) {
    LW_TRY(one, read_merged(merged[i], reader.name_of("merged", i)));
    file.merged.push_back(std::move(one));
  }
  return file;
}

}  // namespace lightwell
