// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/surface_cache.h"

#include <algorithm>

#include "lightwell/base/fingerprint.h"
#include "lightwell/base/parallel.h"

namespace lightwell {
namespace {

/// Rays that look for cells from all viewpoints together.
constexpr size_t most_looks = 1 << 19;
/// Points of a cell that its samples start from.
constexpr size_t most_places = 8;
/// Rounds of looking for cells from those of the round before. What the last one sees for the first time is dark.
constexpr int most_rounds = 12;
/// A scene that would need more cells gets the light of the larger ones around them for the rest.
constexpr size_t most_cells = size_t(1) << 22;
/// Levels of larger cells that answer for a cell that was never seen.
constexpr int parent_levels = 4;
/// Bounces after which the light of the next is left out, and the share of all light below which it is.
constexpr int most_bounces = 256;
constexpr double least_change = 1e-4;

/// A point where a ray met a cell.
struct Sighting {
  uint64_t cell = 0;
  Vec3f position{}, facing{};
};

/// A share of another cell's irradiance.
struct Link {
  uint64_t cell = 0;
  Vec3f weight{};
};

/// What the samples of a cell have found.
struct CellLight {
  Vec3f known{};  // irradiance straight from luminaires, or by gloss
  std::vector<Link> links;
};

struct Place {
  Vec3f position{}, facing{};
};

/// Where a cell is told from others.
struct Middle {
  uint64_t key = 0;
  Place place;
};

struct Cell {
  uint64_t key = 0;
  std::array<Place, most_places> places;
  uint32_t place_count = 0;
};

/// Cells from sightings: sorted by cell, at most so many places of each, spread over its sightings.
std::vector<Cell> cells_of(std::vector<Sighting> sightings) {
  std::stable_sort(sightings.begin(), sightings.end(),
                   [](const Sighting& a, const Sighting& b) { return a.cell < b.cell; });
  std::vector<Cell> cells;
  for (size_t begin = 0; begin < sightings.size();) {
    size_t end = begin;
    while (end < sightings.size() && sightings[end].cell == sightings[begin].cell) end++;
    const size_t count = std::min(most_places, end - begin);
    Cell cell{.key = sightings[begin].cell, .places = {}, .place_count = static_cast<uint32_t>(count)};
    for (size_t i = 0; i < count; i++) {
      const Sighting& chosen = sightings[begin + i * (end - begin) / count];
      cell.places[i] = {chosen.position, chosen.facing};
    }
    cells.push_back(cell);
    begin = end;
  }
  return cells;
}

}  // namespace

/// Builds a cache round by round: cells, their samples, the cells that those see.
class SurfaceCacheBuilder {
 public:
  SurfaceCacheBuilder(const World& world, const SurfaceCacheOptions& options, SurfaceCache& cache)
      : world_(world), options_(options), cache_(cache) {
    threads_ = options.threads > 0 ? options.threads : default_threads();
  }

  Result<void> build(std::span<const Vec3f> viewpoints, Progress& progress) {
    std::vector<Sighting> sightings = look_around(viewpoints, progress);
    for (int round = 0; round < most_rounds && !sightings.empty(); round++) {
      const std::vector<Cell> cells = number(cells_of(std::move(sightings)));
      sightings = sample(cells, std::max(4, options_.samples >> round), progress);
      if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
    }
    solve();
    if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
    smooth();
    cache_.finish();
    return {};
  }

 private:
  void see(const Gathering& gathering, std::vector<Sighting>& seen) const {
    for (size_t i = 0; i < gathering.diffuse_count; i++) {
      const Gathering::Diffuse& point = gathering.diffuse[i];
      if (max_component(point.albedo) <= 0) continue;
      const uint64_t cell = cache_.cells_.at(point.position, point.facing);
      if (!cache_.numbers_.contains(cell)) seen.push_back({cell, point.position, point.facing});
    }
  }

  std::vector<Sighting> look_around(std::span<const Vec3f> viewpoints, Progress& progress) {
    const size_t rays = std::clamp<size_t>(most_looks / std::max<size_t>(viewpoints.size(), 1), 4, 64);
    return collect(viewpoints.size(), progress, [&](size_t i, std::vector<Sighting>& seen) {
      Random random(options_.seed ^ 0x5eed, i);
      const float u = random.uniform(), v = random.uniform();
      uint64_t traced = 0;
      for (size_t k = 0; k < rays; k++) {
        const Gathering gathering =
            gather(world_, {viewpoints[i], sphere_direction(k, rays, u, v)}, cache_.near(), random);
        see(gathering, seen);
        traced += static_cast<uint64_t>(gathering.rays);
      }
      return traced;
    });
  }

  /// What body(i, seen) sees for all i, in their order. It gives the rays that it traced.
  template <typename Body>
  std::vector<Sighting> collect(size_t count, Progress& progress, const Body& body) {
    constexpr size_t grain = 64;
    std::vector<std::vector<Sighting>> parts((count + grain - 1) / grain);
    std::vector<uint64_t> rays(static_cast<size_t>(threads_));
    parallel_for(
        count, grain, threads_,
        [&](size_t begin, size_t end, int thread) {
          for (size_t i = begin; i < end; i++) rays[static_cast<size_t>(thread)] += body(i, parts[begin / grain]);
        },
        [&] { return progress.cancelled(); });
    std::vector<Sighting> all;
    for (std::vector<Sighting>& part : parts) all.insert(all.end(), part.begin(), part.end());
    for (const uint64_t r : rays) cache_.rays_ += r;
    return all;
  }

  /// Gives new cells their numbers, as far as there is room.
  std::vector<Cell> number(std::vector<Cell> cells) {
    if (lights_.size() + cells.size() > most_cells) cells.resize(most_cells - lights_.size());
    first_ = lights_.size();
    for (const Cell& cell : cells) cache_.numbers_.emplace(cell.key, static_cast<uint32_t>(cache_.numbers_.size()));
    lights_.resize(first_ + cells.size());
    for (const Cell& cell : cells) middles_.push_back({cell.key, cell.places[0]});
    return cells;
  }

  std::vector<Sighting> sample(const std::vector<Cell>& cells, int samples, Progress& progress) {
    return collect(cells.size(), progress, [&](size_t i, std::vector<Sighting>& seen) {
      const Cell& cell = cells[i];
      CellLight& light = lights_[first_ + i];
      Random random(options_.seed, cell.key);
      uint64_t rays = 0;
      const float share = 1 / static_cast<float>(samples);
      for (int s = 0; s < samples; s++) {
        const Place& place = cell.places[static_cast<size_t>(s) % cell.place_count];
        rays += sample_lights(place, share, random, light);
        rays += sample_surroundings(place, share, random, light, seen);
      }
      light.links.shrink_to_fit();
      return rays;
    });
  }

  uint64_t sample_lights(const Place& place, float share, Random& random, CellLight& light) const {
    const Arrival arrival = world_.lights().sample(place.position, random);
    const float cosine = dot(place.facing, arrival.direction);
    if (cosine <= 0 || max_component(arrival.radiance) <= 0) return 0;
    const Vec3f seen = visibility(world_.surfaces(), place.position, place.facing, arrival, random);
    const float weight = arrival.extended ? power_heuristic(arrival.density, cosine / pi) : 1.0f;
    light.known += seen * arrival.radiance * (cosine * weight * share / arrival.density);
    return 1;
  }

  uint64_t sample_surroundings(const Place& place, float share, Random& random, CellLight& light,
                               std::vector<Sighting>& seen) const {
    const Vec3f direction = sample_cosine_hemisphere(place.facing, random);
    const float density = dot(direction, place.facing) / pi;
    if (!(density > 0)) return 0;
    const Ray ray{world_.surfaces().leave(place.position, place.facing), direction};
    const Gathering gathering = gather(world_, ray, cache_.near(), random);
    light.known += gathering.mirrored * (pi * share);
    if (gathering.luminaire >= 0) {
      const Lights& lights = world_.lights();
      const float other = gathering.meets_surface ? lights.density(place.position, gathering.first)
                                                  : lights.environment_density(direction);
      light.known += gathering.emitted * (pi * share * power_heuristic(density, other));
    }
    for (size_t i = 0; i < gathering.diffuse_count; i++) {
      const Gathering::Diffuse& point = gathering.diffuse[i];
      if (max_component(point.albedo) <= 0) continue;
      const uint64_t cell = cache_.cells_.at(point.position, point.facing);
      light.links.push_back({cell, point.albedo * share});
      if (!cache_.numbers_.contains(cell)) seen.push_back({cell, point.position, point.facing});
    }
    return static_cast<uint64_t>(gathering.rays);
  }

  /// Jacobi's iteration: one bounce more each time. Each cell's sum has an order of its own, so threads do not matter.
  void solve() {
    struct Share {
      uint32_t cell;
      Vec3f weight;
    };
    std::vector<size_t> first{0};
    std::vector<Share> shares;
    for (CellLight& light : lights_) {
      for (const Link& link : light.links)
        if (const auto found = cache_.numbers_.find(link.cell); found != cache_.numbers_.end())
          shares.push_back({found->second, link.weight});
      light.links = {};
      first.push_back(shares.size());
    }
    std::vector<Vec3f>& irradiance = cache_.irradiance_;
    irradiance.resize(lights_.size());
    for (size_t i = 0; i < lights_.size(); i++) irradiance[i] = lights_[i].known;
    std::vector<Vec3f> next(irradiance.size());
    for (int bounce = 0; bounce < most_bounces; bounce++) {
      parallel_for(next.size(), 4096, threads_, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; i++) {
          Vec3f sum = lights_[i].known;
          for (size_t k = first[i]; k < first[i + 1]; k++) sum += shares[k].weight * irradiance[shares[k].cell];
          next[i] = sum;
        }
      });
      double change = 0, size = 0;
      for (size_t i = 0; i < next.size(); i++) {
        change += static_cast<double>(mean_of_channels(next[i]) - mean_of_channels(irradiance[i]));
        size += static_cast<double>(mean_of_channels(next[i]));
      }
      std::swap(irradiance, next);
      if (std::abs(change) <= least_change * size) break;
    }
  }

  /// Gives each cell the mean of itself and those around it that face the same way and that it sees: their samples are
  /// few, and a room that the sky lights by a window needs many. Walls keep apart what they stand between.
  void smooth() {
    const std::vector<Vec3f>& irradiance = cache_.irradiance_;
    std::vector<Vec3f> smoothed(irradiance.size());
    parallel_for(smoothed.size(), 256, threads_, [&](size_t begin, size_t end, int) {
      for (size_t i = begin; i < end; i++) {
        Random random(options_.seed ^ 0x5300, middles_[i].key);
        Vec3f sum = irradiance[i];
        float count = 1;
        for (int step = 0; step < 27; step++) {
          const uint64_t key = SurfaceCells::beside(middles_[i].key, {{step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1}});
          const auto found = cache_.numbers_.find(key);
          if (found == cache_.numbers_.end() || found->second == i || !sees(i, found->second, random)) continue;
          sum += irradiance[found->second];
          count++;
        }
        smoothed[i] = sum / count;
      }
    });
    cache_.irradiance_ = std::move(smoothed);
  }

  /// Whether nothing stands between two cells, half a cell in front of them.
  bool sees(size_t from, size_t to, Random& random) const {
    const float off = cache_.near() / 2;
    const auto in_front = [&](const Place& place) { return place.position + place.facing * off; };
    const Vec3f start = in_front(middles_[from].place), way = in_front(middles_[to].place) - start;
    const float distance = length(way);
    if (distance <= 0) return true;
    return world_.surfaces().transmittance({start, way / distance, distance}, random) != Vec3f{};
  }

  const World& world_;
  const SurfaceCacheOptions& options_;
  SurfaceCache& cache_;
  std::vector<CellLight> lights_;
  std::vector<Middle> middles_;
  size_t first_ = 0;  // number of the round's first cell
  int threads_ = 1;
};

Result<SurfaceCache> SurfaceCache::build(const World& world, std::span<const Vec3f> viewpoints,
                                         const SurfaceCacheOptions& options, Progress& progress) {
  SurfaceCache cache(SurfaceCells(options.region, options.cell));
  SurfaceCacheBuilder builder(world, options, cache);
  LW_CHECK(builder.build(viewpoints, progress));
  return cache;
}

/// Makes the tables of what is looked up.
void SurfaceCache::finish() {
  ByCell<float> counts;
  light_ = CellTable(irradiance_.size());
  std::vector<uint64_t> cells(irradiance_.size());  // in the order of their numbers, so that the means are reproducible
  for (const auto& [cell, number] : numbers_) cells[number] = cell;
  for (size_t number = 0; number < cells.size(); number++) {
    uint64_t key = cells[number];
    light_.add(key, irradiance_[number]);
    for (int level = 0; level < parent_levels; level++) {
      key = SurfaceCells::parent(key);
      Vec3f& mean = parents_[key];
      mean += (irradiance_[number] - mean) / ++counts[key];
    }
  }
  numbers_ = {};
}

size_t SurfaceCache::bytes() const {
  // A bucket holds, beside its value, how far it is from its place.
  constexpr size_t bucket = sizeof(decltype(parents_)::value_type) + sizeof(uint64_t);
  return irradiance_.capacity() * sizeof(Vec3f) + light_.bytes() + parents_.bucket_count() * bucket;
}

Vec3f SurfaceCache::of_cell(uint64_t cell) const {
  if (const Vec3f* found = light_.find(cell)) return *found;
  for (int level = 0; level < parent_levels; level++) {
    cell = SurfaceCells::parent(cell);
    if (const auto found = parents_.find(cell); found != parents_.end()) return found->second;
  }
  return {};
}

Vec3f SurfaceCache::irradiance(const Vec3f& position, const Vec3f& facing) const {
  return of_cell(cells_.at(position, facing));
}

void SurfaceCache::find_cells(Gathering& gathering) const {
  for (size_t i = 0; i < gathering.diffuse_count; i++) {
    Gathering::Diffuse& point = gathering.diffuse[i];
    point.cell = cells_.at(point.position, point.facing);
    light_.prefetch(point.cell);
  }
}

Vec3f SurfaceCache::reflected(const Gathering& gathering) const {
  Vec3f sum = gathering.mirrored;
  for (size_t i = 0; i < gathering.diffuse_count; i++) {
    const Gathering::Diffuse& point = gathering.diffuse[i];
    sum += point.albedo * of_cell(point.cell) * (1 / pi);
  }
  return sum;
}

uint64_t SurfaceCache::fingerprint(uint64_t seed) const {
  const auto* bytes = reinterpret_cast<const uint8_t*>(irradiance_.data());
  return lightwell::fingerprint({bytes, irradiance_.size() * sizeof(Vec3f)}, seed);
}

}  // namespace lightwell
