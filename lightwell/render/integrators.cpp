// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "lightwell/base/assert.h"
#include "lightwell/render/grid_integrator.h"
#include "lightwell/render/path_integrator.h"

namespace lightwell {

std::span<const IntegratorKind> integrators() {
  static constexpr std::array table{
      IntegratorKind{"path", "path tracing", true, false, make_path_integrator},
      IntegratorKind{"direct", "no bounces", false, false, make_direct_integrator},
      IntegratorKind{"ivg", "the light grid (an irradiance vector grid)", true, true, make_grid_integrator},
  };
  return table;
}

const IntegratorKind& find_integrator(std::string_view name) {
  const auto table = integrators();
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.name == name; });
  LW_ASSERT(found != table.end());
  return *found;
}

}  // namespace lightwell
