// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/mesh_extension.h"

#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

Result<RefinedPrimitive> read_refined_primitive(const Json& json, const std::string& name) {
  MemberReader reader(json, name);
  RefinedPrimitive refined;
  refined.stream = reader.whole("stream");
  refined.vertices = reader.whole("vertices");
  refined.faces = reader.whole("faces");
  refined.error = reader.real("error");
  const Json& box = reader.object("bounds");
  LW_CHECK(reader.finish(true));
  MemberReader bounds(box, name + ".bounds");
  refined.bounds = {bounds.vector("min"), bounds.vector("max")};
  return bounds.finish(refined);
}

}  // namespace

Json to_json(const RefinedPrimitive& refined) {
  return {{"stream", refined.stream},
          {"vertices", refined.vertices},
          {"faces", refined.faces},
          {"bounds", {{"min", to_json(refined.bounds.lo)}, {"max", to_json(refined.bounds.hi)}}},
          {"error", to_json(refined.error)}};
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
