// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// The scene that a glTF document shows: its default scene, or the first one, as it stands in the file: skins and morph
/// targets in their pose, nodes of animations where they are. `origin` is Scene::origin where it is known, else it is
/// found. `report` gets a warning for everything that a bake leaves out or cannot read (lines, points, images of
/// unknown formats or beyond the limit, hidden and flattened nodes).
Result<Scene> scene_from_document(Document document, std::string name, Report& report,
                                  const std::optional<Vec3d>& origin = {}, ImageLimit limit = {});

/// Makes another scene of a document its default one, by name or number. An empty choice keeps the default one.
/// `report` is told of the scenes that are not shown.
Result<void> choose_scene(Document& document, const std::string& choice, Report& report);

/// Tells `report` of a document's variants (KHR_materials_variants): the materials that primitives name are baked.
void name_variants(const Json& document, Report& report);

/// Turns a document into one in metres with y up, by a root node above all others. One that is so already stays as it
/// is.
void reorient(Document& document, const Orientation& orientation);

}  // namespace lightwell
