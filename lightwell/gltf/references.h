// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "lightwell/gltf/json.h"

namespace lightwell {

/// Where a reference stands. Its text is made when it is asked for: documents have a million references, and few of
/// them are ever named.
class ReferencePlace {
 public:
  /// From a value to one inside of it: an element's index, or a member's key.
  using Step = std::variant<size_t, std::string_view>;

  ReferencePlace(std::string_view pattern, std::span<const Step> steps) : pattern_(pattern), steps_(steps) {}

  /// "scenes[].nodes[]".
  std::string_view pattern() const { return pattern_; }
  /// "scenes[0].nodes[2]".
  std::string text() const;

 private:
  std::string_view pattern_;
  std::span<const Step> steps_;
};

/// Receives an index in a document's JSON: its value, the array that it points into ("nodes",
/// "extensions.KHR_lights_punctual.lights") and its place.
template <typename AnyJson>
using ReferenceVisitor = std::function<void(AnyJson& value, std::string_view array, const ReferencePlace& place)>;

/// Visits every reference between elements of a document that glTF 2.0 or a known extension (extensions.h) defines. The
/// same table serves checking, renumbering and finding unused elements.
void for_each_reference(const Json& json, const ReferenceVisitor<const Json>& visit);
/// Visits those into one array, and looks nowhere else.
void for_each_reference(Json& json, std::string_view array, const ReferenceVisitor<Json>& visit);
void for_each_reference(const Json& json, std::string_view array, const ReferenceVisitor<const Json>& visit);

/// The array of a name given to a visitor; null when the document has none.
const Json& referenced_array(const Json& json, std::string_view array);

}  // namespace lightwell
