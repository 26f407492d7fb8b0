// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/trace/emissive_face.h"
#include "lightwell/trace/environment.h"
#include "lightwell/trace/light_region.h"
#include "lightwell/trace/luminaire.h"

namespace lightwell {

/// The luminaires of a scene and their elements, among which sampling chooses: one for each lamp, one for each face of
/// emissive surface, and one for the environment.
struct LuminaireInventory {
  struct Element {
    int luminaire = 0;  ///< -1: of none that shines
    float weight = 0;   ///< sampling weight: about its power, W
  };

  std::vector<Luminaire> luminaires;
  std::vector<Element> elements;    ///< lamps first, then faces, then the environment
  std::vector<EmissiveFace> faces;  ///< of the elements after those of lamps, in the same order
  std::vector<int> first_element;   ///< of each instance; its faces follow one another; -1: it does not shine
  int environment_luminaire = -1;   ///< its element is the last one; -1 when it is black
  size_t first_face() const { return elements.size() - faces.size() - (environment_luminaire >= 0); }
};

/// Lists the light sources of a scene. Every connected piece of emissive surface is a luminaire, even one that turns
/// out to be black.
LuminaireInventory take_inventory(const TraceScene& scene, const EnvironmentLight& environment,
                                  const LightRegion& region);

/// The same inventory, where all but some luminaires are black. Their faces belong to none: -1.
LuminaireInventory restricted_to(const LuminaireSet& shining, LuminaireInventory inventory);

}  // namespace lightwell
