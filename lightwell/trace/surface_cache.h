// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tsl/robin_map.h>

#include <span>
#include <vector>

#include "lightwell/base/progress.h"
#include "lightwell/trace/cell_table.h"
#include "lightwell/trace/gathering.h"
#include "lightwell/trace/surface_cells.h"

namespace lightwell {

struct SurfaceCacheOptions {
  Box3f region;       ///< in and near which the cells have their size
  float cell = 0.1f;  ///< metres
  int samples = 32;   ///< of the light of a cell
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
};

/// The irradiance of a scene's surfaces, in cells of about one place and one facing. Only cells that can be seen exist:
/// rays from viewpoints find them, and rays from those that are found find more, so that neither the number of
/// triangles nor texture coordinates matter. Each cell's light is a sum over samples: light straight from luminaires is
/// known, and what another cell reflects is a share of that one's irradiance. The sums are solved together, as
/// radiosity is: all bounces at once, each ray traced once. Threads may share it.
class SurfaceCache {
 public:
  /// The world must outlive the cache. The same for any number of threads. Fails when `progress` asks to stop.
  static Result<SurfaceCache> build(const World& world, std::span<const Vec3f> viewpoints,
                                    const SurfaceCacheOptions& options, Progress& progress);

  /// The irradiance at a surface, W/m2, all light included. Where no ray came while the cache was built, that of the
  /// cells around.
  Vec3f irradiance(const Vec3f& position, const Vec3f& facing) const;
  /// The distance, in metres, below which a ray should not end in the cache: see gather().
  float near() const { return cells_.size(); }
  /// Finds out in which cells the surfaces lie that a ray sees, and asks the memory for their light. A few rays later
  /// reflected() need not wait for it.
  void find_cells(Gathering& gathering) const;
  /// The radiance that a ray sees by reflection, W/m2/sr. Its cells have been found.
  Vec3f reflected(const Gathering& gathering) const;

  /// A number for the light of all cells, as good as unique.
  uint64_t fingerprint(uint64_t seed) const;

  size_t cells() const { return irradiance_.size(); }
  /// The memory that it keeps.
  size_t bytes() const;
  /// Rays that it took.
  uint64_t rays() const { return rays_; }

 private:
  explicit SurfaceCache(const SurfaceCells& cells) : cells_(cells) {}
  void finish();
  Vec3f of_cell(uint64_t cell) const;

  SurfaceCells cells_;
  template <typename Value>
  using ByCell = tsl::robin_map<uint64_t, Value, CellTable::Mixed>;
  ByCell<uint32_t> numbers_;  // into irradiance_; while it is built
  std::vector<Vec3f> irradiance_;
  CellTable light_;        // the same in one step
  ByCell<Vec3f> parents_;  // mean irradiance of the cells in larger ones
  uint64_t rays_ = 0;

  friend class SurfaceCacheBuilder;
};

}  // namespace lightwell
