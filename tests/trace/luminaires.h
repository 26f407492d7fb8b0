// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/luminaire.h"

namespace lightwell {

/// The set of the luminaires with a 1, in their order.
inline LuminaireSet luminaires(const std::vector<int>& flags) {
  LuminaireSet set;
  for (size_t i = 0; i < flags.size(); i++)
    if (flags[i]) set.insert(static_cast<int>(i));
  return set;
}

}  // namespace lightwell
