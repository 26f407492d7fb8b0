// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "lightwell/render/direct_integrator.h"
#include "lightwell/render/grid_integrator.h"
#include "lightwell/render/path_integrator.h"

namespace lightwell {

std::span<const IntegratorKind> integrators() {
  static constexpr std::array table{
      IntegratorKind{"path", "path tracing", true, false, false, make_path_integrator},
      IntegratorKind{"direct", "no bounces", false, false, true, make_direct_integrator},
      IntegratorKind{"ivg", "the light grid (an irradiance vector grid)", true, true, true, make_grid_integrator},
  };
  return table;
}

}  // namespace lightwell
