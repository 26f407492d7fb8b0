// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/document.h"
#include "lightwell/gltf/resource.h"

namespace lightwell {

Result<std::vector<uint8_t>> read_image(const Document& document, int image) {
  const std::string name = element_name("images", static_cast<size_t>(std::max(0, image)));
  const Json& json = element(member(document.json, "images"), static_cast<size_t>(image));
  if (const int view = index_of(json, "bufferView"); view >= 0) {
    const Json& range = element(member(document.json, "bufferViews"), static_cast<size_t>(view));
    LW_TRY(bytes, locate_range(document, range, name));
    return std::vector<uint8_t>(bytes.begin(), bytes.end());
  }
  if (!member(json, "uri").is_string()) return fail(name, "has neither a bufferView nor a URI");
  auto bytes = read_uri(text(json, "uri"), document.folder);
  if (!bytes) return fail(in_element(bytes.error(), name));
  return bytes;
}

}  // namespace lightwell
