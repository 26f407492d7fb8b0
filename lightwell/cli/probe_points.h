// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/render/probe.h"

namespace lightwell {

/// A point of a list, in the coordinates of the scene's file.
struct ListedPoint {
  Vec3d position{};
  Vec3f normal{};
};

/// Reads points from CSV: a first line that names at least x, y, z, nx, ny, nz, in any order and among others, then a
/// point a line. Normals are scaled to length 1. Errors name the line.
Result<std::vector<ListedPoint>> read_probe_points(const std::string& path);

/// The points as a scene with this origin has them.
std::vector<ProbePoint> counted_from(const Vec3d& origin, const std::vector<ListedPoint>& points);

/// CSV with the columns x,y,z,nx,ny,nz,r,g,b,stderr: a line of names and a line for each point.
std::string probe_csv(const std::vector<ListedPoint>& points, const std::vector<ProbeValue>& values);

}  // namespace lightwell
