// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "lightwell/base/assert.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// A reference irradiance, computed by an independent path tracer (tests/data/truth/README.md).
struct TruthPoint {
  Vec3f position{}, normal{}, irradiance{};
  float standard_error = 0;
};

inline Scene truth_scene(const std::string& name) {
  Report report;
  auto scene = load_scene(LIGHTWELL_TEST_DATA "/truth/" + name + ".glb", {}, report);
  LW_ASSERT(scene.has_value());
  return std::move(*scene);
}

/// The points of, for example, "a_cornell.free.indirect".
inline std::vector<TruthPoint> truth_points(const std::string& name) {
  std::ifstream file(LIGHTWELL_TEST_DATA "/truth/" + name + ".csv");
  std::vector<TruthPoint> points;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string cell;
    const auto next = [&] {
      std::getline(cells, cell, ',');
      return std::strtof(cell.c_str(), nullptr);
    };
    TruthPoint point;
    for (Vec3f* v : {&point.position, &point.normal, &point.irradiance}) {
      for (float& x : v->e) x = next();
    }
    point.standard_error = next();
    points.push_back(point);
  }
  LW_ASSERT(!points.empty());
  return points;
}

/// How computed irradiance compares with the truth, all as shares of the truth's mean over points and channels.
struct TruthScore {
  double rms = 0;    ///< with the noise of both, as their standard errors tell it, taken out
  double bias = 0;   ///< mean of computed - truth
  double noise = 0;  ///< standard error of that mean, if the points are independent
  double sigma = 0;  ///< the median over points of the difference in units of its own standard error
};

/// `errors`: the standard error of each computed value; empty: they have none.
inline TruthScore score(const std::vector<TruthPoint>& truth, const std::vector<Vec3f>& computed,
                        const std::vector<float>& errors = {}) {
  double mean = 0, squares = 0, sum = 0, noise = 0;
  std::vector<double> sigmas;
  for (size_t i = 0; i < truth.size(); i++) {
    const Vec3d difference = (computed[i] - truth[i].irradiance).cast<double>();
    const double error = errors.empty() ? 0 : static_cast<double>(errors[i]);
    const double truth_error = static_cast<double>(truth[i].standard_error);
    for (int c = 0; c < 3; c++) {
      mean += static_cast<double>(truth[i].irradiance[c]);
      sum += difference[c];
    }
    squares += dot(difference, difference);
    const double variance = error * error + truth_error * truth_error;
    noise += variance;
    if (variance > 0) sigmas.push_back(std::sqrt(dot(difference, difference) / 3 / variance));
  }
  const double points = static_cast<double>(truth.size());
  mean /= 3 * points;
  std::nth_element(sigmas.begin(), sigmas.begin() + static_cast<ptrdiff_t>(sigmas.size() / 2), sigmas.end());
  return {std::sqrt(std::max(0.0, squares / (3 * points) - noise / points)) / mean, sum / (3 * points) / mean,
          std::sqrt(noise) / points / mean, sigmas[sigmas.size() / 2]};
}

}  // namespace lightwell
