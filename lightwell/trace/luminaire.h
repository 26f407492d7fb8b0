// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "lightwell/base/vector.h"
#include "lightwell/scene/luminaire_id.h"

namespace lightwell {

/// One source of light as a person would count them: a lamp of the scene, a connected piece of emissive surface, or the
/// environment.
struct Luminaire {
  using Kind = LuminaireId::Kind;

  LuminaireId id{};
  int index = -1;  ///< lamp: into Scene::lamps; surface: into Scene::instances
  Vec3f power{};   ///< W; of suns and the environment what enters the sphere round the scene
  // The rest is of a surface alone.
  std::vector<uint32_t> faces{};  ///< of the instance's mesh
  Vec3f center{};                 ///< mean over the area
  float area = 0;                 ///< m2
  bool double_sided = false;

  Kind kind() const { return id.kind; }
};

/// Some of a world's luminaires, by their numbers in Lights::luminaires().
class LuminaireSet {
 public:
  /// The empty set.
  LuminaireSet() = default;
  /// The first `count` luminaires.
  static LuminaireSet all(size_t count) {
    LuminaireSet set;
    set.holds_.assign(count, true);
    return set;
  }

  bool contains(int luminaire) const {
    const auto index = static_cast<size_t>(luminaire);
    return index < holds_.size() && holds_[index];
  }
  void insert(int luminaire) {
    const auto index = static_cast<size_t>(luminaire);
    if (index >= holds_.size()) holds_.resize(index + 1, false);
    holds_[index] = true;
  }
  void erase(int luminaire) {
    if (contains(luminaire)) holds_[static_cast<size_t>(luminaire)] = false;
    while (!holds_.empty() && !holds_.back()) holds_.pop_back();
  }

  bool operator==(const LuminaireSet&) const = default;

 private:
  std::vector<bool> holds_;  // the last one is true
};

}  // namespace lightwell
