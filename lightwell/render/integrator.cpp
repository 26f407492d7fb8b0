// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/integrator.h"

#include <atomic>
#include <chrono>

#include "lightwell/base/parallel.h"
#include "lightwell/render/camera.h"

namespace lightwell {
namespace {

/// What the light of one camera ray adds up to.
class Renderer {
 public:
  Renderer(const TraceScene& scene, const Camera& camera, const RenderOptions& options)
      : scene_(scene), camera_(camera), options_(options) {
    path_.max_bounces = options.integrator == Integrator::path ? options.max_bounces : 0;
    if (options.integrator == Integrator::ivg) path_.apart = options.contained;
  }

  /// The mean radiance over a pixel; adds the rays that it took.
  Vec3f pixel(int x, int y, uint64_t& rays) const {
    const float width = static_cast<float>(options_.width), height = static_cast<float>(options_.height);
    Random random(options_.seed,
                  static_cast<uint64_t>(y) * static_cast<uint64_t>(options_.width) + static_cast<uint64_t>(x));
    Vec3d sum{};
    for (int i = 0; i < options_.samples; i++) {
      const float u = (static_cast<float>(x) + random.uniform()) / width;
      const float v = (static_cast<float>(y) + random.uniform()) / height;
      sum += radiance(camera_ray(camera_, width / height, u, v), random, rays).cast<double>();
    }
    return (sum / options_.samples).cast<float>();
  }

 private:
  Vec3f radiance(const Ray& ray, Random& random, uint64_t& rays) const {
    const bool total = options_.part == LightPart::total;
    Hit hit;
    rays++;
    if (!scene_.intersect(ray, random, hit)) {
      return total ? scene_.lights().environment().radiance(ray.direction) : Vec3f{};
    }
    const Surface surface = scene_.surface(hit);
    const Receiver receiver{.position = hit.position,
                            .normal = hit.facing_normal(),
                            .shading_normal = scene_.shading_normal(hit),
                            .out = -ray.direction,
                            .bsdf = surface.bsdf};
    Vec3f sum = total ? scene_.emission(hit, surface) : Vec3f{};
    if (options_.part != LightPart::indirect || options_.integrator == Integrator::path) {
      const ReceivedLight light = trace_path(scene_, receiver, path_, random);
      rays += static_cast<uint64_t>(light.rays);
      if (options_.part != LightPart::indirect) sum += light.direct;
      if (options_.part != LightPart::direct) sum += light.indirect;
    }
    if (options_.part != LightPart::direct && options_.integrator == Integrator::ivg) {
      sum += reflected_from_grid(*options_.grid, receiver);
    }
    return sum;
  }

  const TraceScene& scene_;
  const Camera& camera_;
  const RenderOptions& options_;
  PathOptions path_;
};

Result<void> check(const RenderOptions& options) {
  if (options.width <= 0 || options.height <= 0) return fail("picture", "its size must be positive");
  if (options.samples <= 0) return fail("picture", "it needs at least one sample a pixel");
  if (options.integrator == Integrator::ivg && !options.grid)
    return fail("picture", "there is no light grid to look up");
  return {};
}

}  // namespace

Vec3f reflected_from_grid(const LightGrid& grid, const Receiver& receiver) {
  const Vec3f& normal = receiver.shading_normal;
  Vec3f light = receiver.bsdf.diffuse * grid.irradiance(receiver.position, normal);
  if (max_component(receiver.bsdf.metal) > 0) {
    const Vec3f mirrored = normalized(normal * (2 * dot(normal, receiver.out)) - receiver.out);
    light += receiver.bsdf.metal * grid.irradiance(receiver.position, mirrored);
  }
  return light / pi;
}

Result<Picture> render(const TraceScene& scene, const Camera& camera, const RenderOptions& options, Progress& progress,
                       RenderStatistics& statistics) {
  LW_CHECK(check(options));
  const auto start = std::chrono::steady_clock::now();
  const Renderer renderer(scene, camera, options);
  Picture picture{options.width, options.height, {}};
  const size_t width = static_cast<size_t>(options.width), height = static_cast<size_t>(options.height);
  picture.pixels.resize(3 * width * height);
  std::atomic<size_t> rows = 0;
  std::atomic<uint64_t> rays = 0;
  progress.stage("picture", static_cast<double>(height), "rows");
  parallel_for(
      height, 1, options.threads,
      [&](size_t begin, size_t end, int) {
        uint64_t of_rows = 0;
        for (size_t i = begin * width; i < end * width; i++) {
          const Vec3f value = renderer.pixel(static_cast<int>(i % width), static_cast<int>(i / width), of_rows);
          std::copy(value.e.begin(), value.e.end(), picture.pixels.begin() + static_cast<ptrdiff_t>(3 * i));
        }
        rays += of_rows;
        progress.advance(static_cast<double>(rows += end - begin));
      },
      [&] { return progress.cancelled(); });
  if (progress.cancelled()) return fail("picture", "cancelled");
  statistics.rays = rays;
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return picture;
}

}  // namespace lightwell
