// SPDX-License-Identifier: Apache-2.0
//
// Tracing photons through dragon-room without depositing them, and gathering its light, compared with Embree alone on
// the same rays, in turns. The counter `ratio` is Embree's time over ours.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <ctime>
#include <memory>

#include "lightwell/trace/gathering.h"
#include "lightwell/trace/photons.h"

namespace lightwell {
namespace {

constexpr uint64_t photons = 100'000;

/// The room, and the rays of its photons' flights.
struct Room {
  Scene scene;
  std::unique_ptr<const World> world;
  std::vector<Ray> rays;
};

const Room* room() {
  static const std::unique_ptr<const Room> loaded = [] {
    auto result = std::make_unique<Room>();
    Report report;
    auto scene = load_scene(LIGHTWELL_SHARED "/data/rooms/dragon-room.glb", {}, report);
    if (!scene) return std::unique_ptr<Room>();
    result->scene = std::move(*scene);
    auto world = World::build(result->scene);
    if (!world) return std::unique_ptr<Room>();
    result->world = std::move(*world);
    Flight flight;
    for (uint64_t i = 0; i < photons; i++) {
      for (PhotonWalk walk(*result->world, 1, i); walk.next(flight);) {
        result->rays.push_back({flight.origin, flight.direction});
      }
    }
    return result;
  }();
  return loaded.get();
}

float walk_photons(const World& world) {
  float sum = 0;
  Flight flight;
  for (uint64_t i = 0; i < photons; i++) {
    for (PhotonWalk walk(world, 1, i); walk.next(flight);) sum += flight.length;
  }
  return sum;
}

float intersect_alone(const TraceScene& trace, const std::vector<Ray>& rays) {
  float sum = 0;
  for (const Ray& ray : rays) {
    RTCRayHit r{};
    r.ray = {.org_x = ray.origin[0],
             .org_y = ray.origin[1],
             .org_z = ray.origin[2],
             .tnear = 0,
             .dir_x = ray.direction[0],
             .dir_y = ray.direction[1],
             .dir_z = ray.direction[2],
             .time = 0,
             .tfar = ray.far,
             .mask = ~0u,
             .id = 0,
             .flags = 0};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(trace.embree(), &context, &r);
    sum += r.ray.tfar;
  }
  return sum;
}

/// Processor time, so that the ratio also holds on a busy machine.
template <typename Run>
double processor_seconds(const Run& run) {
  const std::clock_t start = std::clock();
  benchmark::DoNotOptimize(run());
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void photons_against_embree(benchmark::State& state) {
  if (!room()) {
    state.SkipWithError("../shared/data/rooms/dragon-room.glb is not there");
    return;
  }
  double ours = 0, alone = 0;
  for (auto _ : state) {
    ours += processor_seconds([] { return walk_photons(*room()->world); });
    alone += processor_seconds([] { return intersect_alone(room()->world->surfaces(), room()->rays); });
  }
  const double rays = static_cast<double>(room()->rays.size()) * static_cast<double>(state.iterations());
  state.counters["ratio"] = alone / ours;
  state.counters["photon_rays_per_second"] = rays / ours;
  state.counters["embree_rays_per_second"] = rays / alone;
}
/// Rays into all directions from places spread over the room, as a grid's nodes send them.
std::vector<Ray> gathering_rays(const World& world) {
  constexpr int places = 400, rays_a_place = 256;
  const Box3f box = world.surfaces().focus();
  Random random(2, 0);
  std::vector<Ray> rays;
  for (int i = 0; i < places; i++) {
    const Vec3f share{{random.uniform(), random.uniform(), random.uniform()}};
    for (int k = 0; k < rays_a_place; k++) rays.push_back({box.lo + box.size() * share, sample_sphere(random)});
  }
  return rays;
}

/// Gathers along rays, and lists what it asked of Embree's tree: each ray that it followed.
void gathering_against_embree(benchmark::State& state) {
  if (!room()) {
    state.SkipWithError("../shared/data/rooms/dragon-room.glb is not there");
    return;
  }
  const World& world = *room()->world;
  const std::vector<Ray> rays = gathering_rays(world);
  const auto gather_all = [&] {
    Random random(3, 0);
    int followed = 0;
    for (const Ray& ray : rays) followed += gather(world, ray, 0, random).rays;
    return followed;
  };
  double ours = 0, alone = 0;
  double followed = 0;
  for (auto _ : state) {
    ours += processor_seconds([&] { return followed = gather_all(); });
    alone += processor_seconds([&] { return intersect_alone(world.surfaces(), rays); });
  }
  // Rays that gloss adds are as long as the others.
  const double rays_each = static_cast<double>(rays.size());
  state.counters["ratio"] = alone * (followed / rays_each) / ours;
  state.counters["rays_followed"] = followed / rays_each;
  state.counters["gathering_rays_per_second"] = followed * static_cast<double>(state.iterations()) / ours;
}
BENCHMARK(gathering_against_embree)->Unit(benchmark::kMillisecond)->Iterations(5);
BENCHMARK(photons_against_embree)->Unit(benchmark::kMillisecond)->Iterations(5);

}  // namespace
}  // namespace lightwell

BENCHMARK_MAIN();
