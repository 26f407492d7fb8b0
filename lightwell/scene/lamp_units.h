// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// Makes the intensities of a document's lamps (KHR_lights_punctual) radiometric, as those of its emissive surfaces
/// are: photometric ones are divided by 683 lm/W. What is `automatic` is told by the file: Blender's exporter
/// multiplies watts by that number and leaves emission strengths as they are. `report` is told of a choice that the
/// file made, and of strong lamps beside emission where the file tells nothing.
void make_lamps_radiometric(Document& document, LampUnits units, Report& report);

}  // namespace lightwell
