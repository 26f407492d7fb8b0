// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/lamp_units.h"

#include <algorithm>
#include <cmath>

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

/// Where a file's lamps are as strong as this beside emissive surfaces, W/sr or W/m2, it is likelier that they are in
/// candela and lux: 6 kW in a lamp, or half a sun.
constexpr double strong = 500;

bool has_emission(const Json& document) {
  for (const Json& material : member(document, "materials"))
    for (const Json& colour : member(material, "emissiveFactor"))
      if (colour.is_number() && colour.get<double>() > 0) return true;
  return false;
}

void advise_on_units(const Json& document, Report& report) {
  double strongest = 0;
  for (const Json& light : member(extension(document, "KHR_lights_punctual"), "lights"))
    strongest = std::max(strongest, number(light, "intensity", 1));
  if (strongest >= strong && has_emission(document))
    report.warn("lamps are of up to " + std::to_string(std::lround(std::min(strongest, 1e15))) +
                ", which outshines what is emissive: if the file has them in candela or lux, --lamp-units photometric "
                "says so");
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
    if (!is_of_blender(member(json, "asset"))) return advise_on_units(json, report);
    report.warn(
        "lamps are in lumens, as Blender writes them by default: divided by 683 to agree with emission; "
        "--lamp-units radiometric takes them as they are");
  }
  for (Json& light : json["extensions"]["KHR_lights_punctual"]["lights"])
    light["intensity"] = number(light, "intensity", 1) / lumens_per_watt;
  note_units(json["asset"]);
}

}  // namespace lightwell
