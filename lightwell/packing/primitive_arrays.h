// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>
#include <string>

#include "lightwell/gltf/json.h"
#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// Whether a mesh has what glTF calls by that name.
bool has_attribute(const Mesh& mesh, const std::string& name);

/// Takes the arrays of a primitive away; keeps material, extras and extensions. Collects in `lost` the names of
/// attributes that what is to take their place has not, as `has` tells.
void take_arrays(Json& primitive, const std::function<bool(const std::string& name)>& has, std::set<std::string>& lost);

}  // namespace lightwell
