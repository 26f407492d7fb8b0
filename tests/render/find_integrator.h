// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>

#include "lightwell/base/assert.h"
#include "lightwell/render/integrator.h"

namespace lightwell {

/// The integrator of a name, which must be in the table.
inline const IntegratorKind& find_integrator(std::string_view name) {
  const auto table = integrators();
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.name == name; });
  LW_ASSERT(found != table.end());
  return *found;
}

}  // namespace lightwell
