// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lightwell/scene/import_gltf.h"

namespace lightwell {
namespace {

/// "a, b and 3 more".
std::string list_of(const std::vector<std::string>& names) {
  constexpr size_t most = 5;
  std::string list;
  for (size_t i = 0; i < std::min(names.size(), most); i++) list += (i > 0 ? ", " : "") + names[i].substr(0, 80);
  if (names.size() > most) list += " and " + std::to_string(names.size() - most) + " more";
  return list;
}

}  // namespace

Result<void> choose_scene(Document& document, const std::string& choice, Report& report) {
  Json& json = document.json;
  const Json& scenes = member(json, "scenes");
  const auto name = [&](size_t i) {
    const std::string given = text(scenes[i], "name");
    return given.empty() ? std::to_string(i) : '"' + given + '"';
  };
  std::vector<std::string> names;
  for (size_t i = 0; i < scenes.size(); i++) names.push_back(name(i));
  size_t shown = static_cast<size_t>(std::max(0, index_of(json, "scene")));
  if (!choice.empty()) {
    shown = 0;
    while (shown < scenes.size() && text(scenes[shown], "name") != choice && std::to_string(shown) != choice) shown++;
    if (shown == scenes.size())
      return fail("scene " + choice.substr(0, 80),
                  names.empty() ? "there is none in the file" : "is not in the file, which has " + list_of(names));
    json["scene"] = shown;
  }
  if (names.size() < 2 || shown >= names.size()) return {};
  const std::string chosen = names[shown];
  names.erase(names.begin() + static_cast<std::ptrdiff_t>(shown));
  report.warn("scene " + chosen + " is shown, not " + list_of(names) + "; --scene chooses");
  return {};
}

void name_variants(const Json& document, Report& report) {
  const Json& variants = member(extension(document, "KHR_materials_variants"), "variants");
  std::vector<std::string> names;
  for (size_t i = 0; i < variants.size(); i++) {
    const std::string given = text(variants[i], "name");
    names.push_back(given.empty() ? std::to_string(i) : '"' + given + '"');
  }
  if (!names.empty())
    report.warn("variants " + list_of(names) + " are kept; the light is that of the materials without a variant");
}

}  // namespace lightwell
