// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// Which surfaces bound the inside of a solid on their back. Those that are not double-sided all do. Many files declare
/// solids double-sided, so of the connected pieces of double-sided surface those count too that enclose some volume and
/// whose back photons practically never reach: of the photons that meet the piece, in all its instances, less than one
/// in a thousand comes from behind.
class Solids {
 public:
  explicit Solids(const TraceScene& scene);

  /// How many photons met each piece of double-sided surface, one count a piece for each side.
  struct Hits {
    std::vector<uint64_t> front, back;

    Hits& operator+=(const Hits& other);
  };
  Hits no_hits() const;
  void count(const Hit& hit, Hits& hits) const;
  /// True when so many hits are enough to decide by.
  bool settled(const Hits& hits) const;
  /// Decides by all hits which pieces are solid. Before, none is.
  void decide(const Hits& hits);

  /// True when a ray that ends at this hit began inside a solid.
  bool from_inside(const Hit& hit) const;

 private:
  void add_pieces(const Mesh& mesh, const std::vector<uint32_t>& of_faces);
  std::optional<size_t> piece(const Hit& hit) const;

  const TraceScene& scene_;
  std::vector<std::vector<uint32_t>> pieces_of_faces_;  // of each primitive that is double-sided; else empty
  std::vector<size_t> first_piece_;                     // of each primitive
  std::vector<uint8_t> encloses_;                       // of each piece: it has an inside
  std::vector<uint8_t> solid_;                          // of each piece
};

}  // namespace lightwell
