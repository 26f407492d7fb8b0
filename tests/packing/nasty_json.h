// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lightwell/base/random.h"
#include "lightwell/gltf/json.h"

namespace lightwell {

/// A value that a reader may not expect: of another type, out of range, or nearly right.
inline Json nasty_value(Random& random) {
  static const std::vector<Json> values = {Json(),
                                           true,
                                           "",
                                           "indirect",
                                           0,
                                           1,
                                           -1,
                                           3,
                                           0.5,
                                           -1e30,
                                           1e300,
                                           4294967296.0,
                                           5125,
                                           std::numeric_limits<uint64_t>::max(),
                                           std::numeric_limits<int64_t>::min(),
                                           Json::object(),
                                           Json::array(),
                                           Json::array({1, 2, 3}),
                                           Json::array({1, "2", Json()}),
                                           Json::object({{"kind", "spot"}})};
  return values[random.below(static_cast<uint32_t>(values.size()))];
}

/// Adds the places of all values in a JSON that stands at `here`, without its own.
inline void add_places(const Json& json, const Json::json_pointer& here, std::vector<Json::json_pointer>& places) {
  const auto add = [&](const Json& value, const Json::json_pointer& place) {
    places.push_back(place);
    add_places(value, place, places);
  };
  if (json.is_object())
    for (const auto& [key, value] : json.items()) add(value, here / key);
  if (json.is_array())
    for (size_t i = 0; i < json.size(); i++) add(json[i], here / i);
}

/// Changes a JSON at one place: takes the value away, puts another there, a little different or not at all alike, or
/// changes places with another value.
inline void spoil(Json& json, Random& random) {
  std::vector<Json::json_pointer> places;
  add_places(json, Json::json_pointer(), places);
  if (places.empty()) return;
  const auto any = [&] { return places[random.below(static_cast<uint32_t>(places.size()))]; };
  const Json::json_pointer place = any();
  Json& value = json[place];
  switch (random.below(5)) {
    case 0: {
      Json& parent = json[place.parent_pointer()];
      if (parent.is_object())
        parent.erase(place.back());
      else
        parent.erase(static_cast<size_t>(std::stoul(place.back())));
      break;
    }
    case 1: value = nasty_value(random); break;
    case 2:
      if (value.is_number_integer())
        value = value.get<uint64_t>() + (random.below(2) ? 1 : uint64_t(-1));  // round the corner at the ends
      else if (value.is_number())
        value = value.get<double>() * (random.below(2) ? 1.5 : -1);
      else
        value = nasty_value(random);
      break;
    case 3: {
      const Json other = json.at(any());
      json[place] = other;
      break;
    }
    case 4:
      if (value.is_array() && !value.empty())
        value.push_back(Json(value.front()));
      else if (value.is_object())
        value["extra"] = nasty_value(random);
      break;
  }
}

}  // namespace lightwell
