// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/environment_extension.h"

#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

constexpr float most_stops = 64;

}  // namespace

Json to_json(const EnvironmentPicture& picture) {
  return {{"texture", picture.texture}, {"radiance", to_json(picture.radiance)}, {"stops", to_json(picture.stops)}};
}

Result<std::optional<EnvironmentPicture>> read_environment_picture(const Json& json) {
  const Json& stated = extension(json, environment_extension);
  if (stated.is_null()) return std::nullopt;
  MemberReader reader(stated, environment_extension);
  const EnvironmentPicture picture{reader.whole("texture"), reader.real("radiance"), reader.real("stops")};
  if (element(member(json, "textures"), picture.texture).is_null()) reader.refuse("texture", "is not there");
  if (!(picture.radiance > 0 && picture.radiance <= most_environment_radiance))
    reader.refuse("radiance", "is out of range");
  if (!(picture.stops > 0 && picture.stops <= most_stops)) reader.refuse("stops", "is out of range");
  return reader.finish(std::optional(picture));
}

}  // namespace lightwell
