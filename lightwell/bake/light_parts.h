// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lightwell/bake/light_groups.h"
#include "lightwell/light/light_field.h"

namespace lightwell {

/// The part of a scene's light that one grid holds. All parts add up to all light.
struct LightPart {
  std::string group;        ///< empty: of all luminaires
  LuminaireSet luminaires;  ///< whose light it is
  LuminaireSet contained;   ///< those of them whose direct light is in it
  bool reflected = true;    ///< whether what surfaces reflect is in it
};

/// A part for each group, or one of all luminaires. With the sky apart, each that holds the environment's own light is
/// two: what is reflected, and that light.
std::vector<LightPart> light_parts(const World& world, const LuminaireSet& contained,
                                   std::span<const LightGroup> groups, bool sky_apart);

GridContents contents_of(const LightPart& part, const World& world);

}  // namespace lightwell
