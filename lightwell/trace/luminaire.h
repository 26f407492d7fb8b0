// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "lightwell/base/vector.h"
#include "lightwell/scene/luminaire_id.h"

namespace lightwell {

/// A source of light as a person would count it: a lamp of the scene, a connected piece of emissive surface, or the
/// environment.
struct Luminaire {
  using Kind = LuminaireId::Kind;

  LuminaireId id{};
  int index = -1;  ///< into Scene::lamps for a lamp, Scene::instances for a surface
  Vec3f power{};   ///< W; for suns and the environment, what enters LightRegion's sphere
  // Only for surfaces:
  std::vector<uint32_t> faces{};  ///< of the instance's mesh
  Vec3f center{};                 ///< mean over the area
  float area = 0;                 ///< m2
  bool double_sided = false;

  Kind kind() const { return id.kind; }
};

/// A set of a world's luminaires, given by their indices in Lights::luminaires().
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

  /// One more than the greatest index in it.
  int size() const { return static_cast<int>(holds_.size()); }

  bool operator==(const LuminaireSet&) const = default;

 private:
  std::vector<bool> holds_;  // never ends in false, so that equal sets compare equal
};

/// By how much the light of each of a world's luminaires is multiplied, for each colour.
class LuminaireFactors {
 public:
  void set(int luminaire, const Vec3f& factor) {
    const auto index = static_cast<size_t>(luminaire);
    if (index >= factors_.size()) factors_.resize(index + 1, Vec3f::filled(1));
    factors_[index] = factor;
  }
  /// Of those that were not set, and of none, it is 1.
  Vec3f of(int luminaire) const {
    const auto index = static_cast<size_t>(luminaire);
    return index < factors_.size() ? factors_[index] : Vec3f::filled(1);
  }

 private:
  std::vector<Vec3f> factors_;
};
inline const LuminaireFactors as_they_are;

}  // namespace lightwell
