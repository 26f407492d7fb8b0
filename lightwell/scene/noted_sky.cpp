// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/noted_sky.h"

#include <algorithm>

#include "lightwell/scene/physical_sky.h"

namespace lightwell {
namespace {

constexpr const char* radiance_key = "skyRadiance";
constexpr const char* turbidity_key = "skyTurbidity";
constexpr double most_radiance = 1e12;  // products stay finite in floats

size_t shown_scene(const Json& document) { return static_cast<size_t>(std::max(0, index_of(document, "scene"))); }

// The object under this key, which replaces anything else that a file may have there.
Json& object_in(Json& json, const char* key) {
  Json& value = json[key];
  if (!value.is_object()) value = Json::object();
  return value;
}

}  // namespace

NotedSky noted_sky(const Json& document) {
  const Json& notes = member(member(element(member(document, "scenes"), shown_scene(document)), "extras"), "lightwell");
  NotedSky sky;
  if (member(notes, radiance_key).is_array()) {
    const Vec3d radiance = numbers<3>(notes, radiance_key, Vec3d{});
    sky.radiance = min(max(radiance, Vec3d{}), Vec3d::filled(most_radiance)).cast<float>();
  }
  if (member(notes, turbidity_key).is_number())
    sky.turbidity =
        std::clamp(static_cast<float>(number(notes, turbidity_key, usual_turbidity)), least_turbidity, most_turbidity);
  return sky;
}

void note_sky(Json& document, const NotedSky& sky) {
  const NotedSky before = noted_sky(document);
  if (!sky.radiance && !sky.turbidity && !before.radiance && !before.turbidity) return;
  Json& notes = object_in(object_in(document["scenes"][shown_scene(document)], "extras"), "lightwell");
  notes.erase(radiance_key);
  notes.erase(turbidity_key);
  if (sky.radiance) notes[radiance_key] = sky.radiance->e;
  if (sky.turbidity) notes[turbidity_key] = shortest(*sky.turbidity);
}

}  // namespace lightwell
