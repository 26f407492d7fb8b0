// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/lamp_units.h"

namespace lightwell {
namespace {

/// Lumens of a watt at 555 nm (SI: the luminous efficacy that defines the candela).
constexpr double lumens_per_watt = 683;

bool has_lamps(const Json& document) { return !member(extension(document, "KHR_lights_punctual"), "lights").empty(); }

/// Whether Blender has written the file, and nobody has made its lamps radiometric since.
bool is_of_blender(const Json& asset) {
  return text(asset, "generator").find("Khronos glTF Blender I/O") != std::string::npos &&
         text(member(member(asset, "extras"), "lightwell"), "lampUnits") != "radiometric";
}

/// Notes in the document that its lamps are radiometric, for who reads it again.
void note_units(Json& asset) {
  for (Json* object : {&asset["extras"], &asset["extras"]["lightwell"]})
    if (!object->is_object()) *object = Json::object();
  asset["extras"]["lightwell"]["lampUnits"] = "radiometric";
}

}  // namespace

void make_lamps_radiometric(Document& document, LampUnits units, Report& report) {
  Json& json = document.json;
  if (!has_lamps(json) || units == LampUnits::radiometric) return;
  if (units == LampUnits::automatic) {
    if (!is_of_blender(member(json, "asset"))) return;
    report.warn(
        "lamps are in lumens, as Blender writes them by default: divided by 683 to agree with emission; "
        "--lamp-units radiometric takes them as they are");
  }
  for (Json& light : json["extensions"]["KHR_lights_punctual"]["lights"])
    light["intensity"] = number(light, "intensity", 1) / lumens_per_watt;
  note_units(json["asset"]);
}

}  // namespace lightwell
