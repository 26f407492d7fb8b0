// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/bake/surface_pieces.h"

namespace lightwell {

/// Tells which surfaces have the inside of a solid behind them. Those that are not double-sided all do. Many files
/// declare solids double-sided, so a connected piece of double-sided surface counts, too, if it encloses some volume
/// and photons practically never reach its back: in all its instances together, at most one hit on the back for a
/// thousand on the front, or 12 for a hundred where it is closed but for holes, as scans are.
class Solids {
 public:
  explicit Solids(const TraceScene& scene);

  /// The numbers of photons that hit the front and the back of each piece of double-sided surface.
  struct Hits {
    std::vector<uint64_t> front, back;

    Hits& operator+=(const Hits& other);
  };
  Hits no_hits() const;
  void count(const Hit& hit, Hits& hits) const;
  /// True when there are enough hits to decide by.
  bool settled(const Hits& hits) const;
  /// Decides from all hits which pieces are solid. Until then none is.
  void decide(const Hits& hits);

  /// True when a ray that ends at this hit began inside a solid.
  bool from_inside(const Hit& hit) const;

 private:
  SurfacePieces pieces_;             // double-sided ones
  std::vector<uint8_t> encloses_;    // of each piece: whether it has an inside
  std::vector<double> most_inside_;  // of each piece: light on the back of a solid, relative to the front
  std::vector<uint8_t> solid_;       // of each piece
};

}  // namespace lightwell
