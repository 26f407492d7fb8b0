// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/lamps_extension.h"

#include <array>
#include <optional>
#include <string_view>

#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

using Kind = ClientLamp::Kind;

constexpr std::array<std::pair<Kind, const char*>, 6> kinds = {{{Kind::rectangle, "rectangle"},
                                                                {Kind::disc, "disc"},
                                                                {Kind::sphere, "sphere"},
                                                                {Kind::point, "point"},
                                                                {Kind::spot, "spot"},
                                                                {Kind::sun, "sun"}}};

const char* name_of(Kind kind) {
  for (const auto& [known, name] : kinds)
    if (known == kind) return name;
  return "";
}

std::optional<Kind> kind_of(std::string_view name) {
  for (const auto& [kind, known] : kinds)
    if (known == name) return kind;
  return std::nullopt;
}

// Which fields a lamp of each kind has.
bool has_center(Kind kind) { return kind != Kind::sun; }
bool has_normal(Kind kind) { return kind != Kind::point && kind != Kind::sphere; }
bool is_flat(Kind kind) { return kind == Kind::rectangle || kind == Kind::disc; }
bool is_round(Kind kind) { return kind == Kind::disc || kind == Kind::sphere; }
bool is_surface(Kind kind) { return is_flat(kind) || is_round(kind); }

Json lamp_json(const ClientLamp& lamp) {
  Json json{{"kind", name_of(lamp.kind)}};
  if (!lamp.name.empty()) json["name"] = lamp.name;
  if (!lamp.group.empty()) json["group"] = lamp.group;
  if (has_center(lamp.kind)) json["center"] = to_json(lamp.center);
  if (has_normal(lamp.kind)) json["normal"] = to_json(lamp.normal);
  if (lamp.kind == Kind::rectangle) {
    json["u"] = to_json(lamp.half_u);
    json["v"] = to_json(lamp.half_v);
  }
  if (is_flat(lamp.kind) && lamp.two_sided) json["twoSided"] = true;
  if (is_round(lamp.kind)) json["radius"] = to_json(lamp.radius);
  if (is_surface(lamp.kind))
    json["radiance"] = to_json(lamp.radiance);
  else
    json["intensity"] = to_json(lamp.intensity);
  if (lamp.range > 0) json["range"] = to_json(lamp.range);
  if (lamp.kind == Kind::spot) {
    json["innerConeAngle"] = to_json(lamp.inner_cone);
    json["outerConeAngle"] = to_json(lamp.outer_cone);
  }
  if (lamp.luminaire.node >= 0) json["node"] = lamp.luminaire.node;
  if (is_surface(lamp.kind)) {
    if (lamp.luminaire.copy > 0) json["copy"] = lamp.luminaire.copy;
    if (lamp.luminaire.primitive >= 0) json["primitive"] = lamp.luminaire.primitive;
    json["vertex"] = lamp.luminaire.vertex;
  }
  return json;
}

Result<ClientLamp> read_lamp(const Json& json, const std::string& name) {
  MemberReader reader(json, name);
  ClientLamp lamp;
  const std::optional<Kind> kind = kind_of(reader.string("kind"));
  if (!kind) reader.refuse("kind", "is no kind of lamp");
  lamp.kind = kind.value_or(Kind::point);
  if (reader.has("name")) lamp.name = reader.string("name");
  if (reader.has("group")) lamp.group = reader.string("group");
  if (has_center(lamp.kind)) lamp.center = reader.vector("center");
  if (has_normal(lamp.kind)) lamp.normal = reader.vector("normal");
  if (lamp.kind == Kind::rectangle) {
    lamp.half_u = reader.vector("u");
    lamp.half_v = reader.vector("v");
  }
  if (is_flat(lamp.kind)) lamp.two_sided = reader.flag("twoSided");
  if (is_round(lamp.kind)) lamp.radius = reader.real("radius");
  (is_surface(lamp.kind) ? lamp.radiance : lamp.intensity) =
      reader.vector(is_surface(lamp.kind) ? "radiance" : "intensity");
  if (reader.has("range")) lamp.range = reader.real("range");
  if (lamp.kind == Kind::spot) {
    lamp.inner_cone = reader.real("innerConeAngle");
    lamp.outer_cone = reader.real("outerConeAngle");
  }
  lamp.luminaire.kind = is_surface(lamp.kind) ? LuminaireId::Kind::surface : LuminaireId::Kind::lamp;
  if (reader.has("node")) lamp.luminaire.node = static_cast<int>(reader.whole("node"));
  if (is_surface(lamp.kind)) {
    if (reader.has("copy")) lamp.luminaire.copy = static_cast<int>(reader.whole("copy"));
    if (reader.has("primitive")) lamp.luminaire.primitive = static_cast<int>(reader.whole("primitive"));
    lamp.luminaire.vertex = static_cast<uint32_t>(reader.whole("vertex"));
  }
  if (lamp.radius < 0) reader.refuse("radius", "is negative");
  if (lamp.range < 0) reader.refuse("range", "is negative");
  return reader.finish(std::move(lamp));
}

}  // namespace

Json to_json(std::span<const ClientLamp> lamps) {
  Json list = Json::array();
  for (const ClientLamp& lamp : lamps) list.push_back(lamp_json(lamp));
  return {{"lamps", std::move(list)}};
}

Result<std::vector<ClientLamp>> read_lamps(const Json& json) {
  MemberReader reader(extension(json, lamps_extension), lamps_extension);
  const Json& list = reader.array("lamps");
  if (list.size() > most_client_lamps) reader.refuse("lamps", "are more than 16");
  std::vector<ClientLamp> lamps;
  LW_CHECK(reader.finish(true));
  for (size_t i = 0; i < list.size(); i++) {
    LW_TRY(lamp, read_lamp(list[i], reader.name_of("lamps", i)));
    lamps.push_back(std::move(lamp));
  }
  return lamps;
}

}  // namespace lightwell
