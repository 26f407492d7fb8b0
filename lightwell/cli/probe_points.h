// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/render/probe.h"

namespace lightwell {

/// Reads points from CSV: a first line that names at least x, y, z, nx, ny, nz, in any order and among others, then a
/// point a line. Normals are scaled to length 1. Errors name the line.
Result<std::vector<ProbePoint>> read_probe_points(const std::string& path);

/// CSV with the columns x,y,z,nx,ny,nz,r,g,b,stderr: a line of names and a line for each point, with all digits of a
/// float.
std::string probe_csv(const std::vector<ProbePoint>& points, const std::vector<ProbeValue>& values);

}  // namespace lightwell
