// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "lightwell/gltf/json.h"

namespace lightwell {

/// Receives an index in a document's JSON: its value, the array that it points into ("nodes",
/// "extensions.KHR_lights_punctual.lights") and its place ("scenes[0].nodes[2]").
template <typename AnyJson>
using ReferenceVisitor = std::function<void(AnyJson& value, std::string_view array, const std::string& place)>;

/// Visits every reference between elements of a document that glTF 2.0 or a known extension (extensions.h) defines. The
/// same table serves checking, renumbering and finding unused elements.
void for_each_reference(Json& json, const ReferenceVisitor<Json>& visit);
void for_each_reference(const Json& json, const ReferenceVisitor<const Json>& visit);

/// The array of a name given to a visitor; null when the document has none.
const Json& referenced_array(const Json& json, std::string_view array);

}  // namespace lightwell
