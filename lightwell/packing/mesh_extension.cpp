// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/mesh_extension.h"

#include <algorithm>
#include <initializer_list>

#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

using Accessors = std::map<std::string, int>;

Result<Accessors> read_accessors(const Json& json, const std::string& name,
                                 std::initializer_list<const char*> semantics) {
  MemberReader reader(json, name);
  Accessors accessors;
  for (const auto& item : json.items()) {
    const std::string& semantic = item.key();
    const bool known = std::ranges::any_of(semantics, [&](const char* start) { return semantic.starts_with(start); });
    if (!known) return fail(name, "an attribute that bends nothing: " + semantic.substr(0, 40));
    accessors[semantic] = static_cast<int>(reader.whole(semantic.c_str()));
  }
  return reader.finish(std::move(accessors));
}

Result<DeformationAccessors> read_deformation(const Json& json, const std::string& name) {
  MemberReader reader(json, name);
  const Json& attributes = reader.object("attributes");
  const Json& targets = reader.array("targets");
  LW_CHECK(reader.finish(true));
  DeformationAccessors deformation;
  LW_TRY(skin, read_accessors(attributes, name + ".attributes", {"JOINTS_", "WEIGHTS_"}));
  deformation.attributes = std::move(skin);
  for (size_t i = 0; i < targets.size(); i++) {
    const std::string target = reader.name_of("targets", i);
    if (!targets[i].is_object()) return fail(target, "is not an object");
    LW_TRY(displacements, read_accessors(targets[i], target, {"POSITION", "NORMAL"}));
    deformation.targets.push_back(std::move(displacements));
  }
  return deformation;
}

Result<RefinedPrimitive> read_refined_primitive(const Json& json, const std::string& name) {
  MemberReader reader(json, name);
  RefinedPrimitive refined;
  refined.stream = reader.whole("stream");
  if (reader.has("region")) refined.region = reader.whole("region");
  refined.faces = reader.whole("faces");
  if (refined.region == 0) {
    refined.vertices = reader.whole("vertices");
    refined.error = reader.real("error");
  }
  const Json& box = reader.object("bounds");
  LW_CHECK(reader.finish(true));
  MemberReader bounds(box, name + ".bounds");
  refined.bounds = {bounds.vector("min"), bounds.vector("max")};
  if (reader.has("deformation")) {
    LW_TRY(deformation, read_deformation(json["deformation"], name + ".deformation"));
    refined.deformation = std::move(deformation);
  }
  return bounds.finish(refined);
}

}  // namespace

Json to_json(const RefinedPrimitive& refined) {
  Json json = {{"stream", refined.stream},
               {"faces", refined.faces},
               {"bounds", {{"min", to_json(refined.bounds.lo)}, {"max", to_json(refined.bounds.hi)}}}};
  if (refined.region > 0) {
    json["region"] = refined.region;
  } else {
    json["vertices"] = refined.vertices;
    json["error"] = to_json(refined.error);
  }
  if (refined.deformation)
    json["deformation"] = {{"attributes", refined.deformation->attributes}, {"targets", refined.deformation->targets}};
  return json;
}

Result<std::vector<RefinedPrimitive>> read_refined_primitives(const Json& json) {
  std::vector<RefinedPrimitive> found;
  const Json& meshes = member(json, "meshes");
  for (size_t m = 0; m < meshes.size(); m++) {
    const Json& primitives = member(element(meshes, m), "primitives");
    for (size_t p = 0; p < primitives.size(); p++) {
      const Json& said = extension(element(primitives, p), mesh_extension);
      if (said.is_null()) continue;
      LW_TRY(refined, read_refined_primitive(said, element_name("meshes", m) + "." + element_name("primitives", p) +
                                                       "." + mesh_extension));
      refined.mesh = m;
      refined.primitive = p;
      found.push_back(refined);
    }
  }
  return found;
}

}  // namespace lightwell
