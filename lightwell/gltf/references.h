// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "lightwell/gltf/json.h"

namespace lightwell {

/// A place in a document's JSON that holds an index: the value, the array it points into ("nodes",
/// "extensions.KHR_lights_punctual.lights") and where it stands ("scenes[0].nodes[2]").
template <typename AnyJson>
using ReferenceVisitor = std::function<void(AnyJson& value, std::string_view array, const std::string& place)>;

/// Visits every reference between elements of a document that glTF 2.0 or an extension of extensions.h defines.
/// This one table serves checking, renumbering and the search for unused elements.
void for_each_reference(Json& json, const ReferenceVisitor<Json>& visit);
void for_each_reference(const Json& json, const ReferenceVisitor<const Json>& visit);

/// The array that a visitor is told of; null when the document has none.
const Json& referenced_array(const Json& json, std::string_view array);

}  // namespace lightwell
