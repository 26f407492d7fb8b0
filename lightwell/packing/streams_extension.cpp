// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/streams_extension.h"

#include "lightwell/packing/member_reader.h"

namespace lightwell {

Json to_json(const PackIdentity& identity) {
  Json json = {{"version", identity.version},
               {"id", identity.id},
               {"generator", identity.generator},
               {"exposure", to_json(identity.exposure)}};
  if (identity.origin != Vec3d{}) json["origin"] = identity.origin.e;
  return json;
}

Result<PackIdentity> read_identity(const Json& json) {
  MemberReader reader(extension(json, streams_extension), streams_extension);
  PackIdentity identity;
  identity.version = reader.whole("version");
  identity.id = reader.string("id");
  identity.generator = reader.string("generator");
  identity.exposure = reader.real("exposure");
  if (reader.has("origin")) identity.origin = reader.exact_vector("origin");
  return reader.finish(std::move(identity));
}

}  // namespace lightwell
