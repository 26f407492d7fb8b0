// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/render.h"

#include <atomic>
#include <chrono>

#include "lightwell/base/parallel.h"
#include "lightwell/render/camera.h"

namespace lightwell {
namespace {

/// Computes the pixels of a picture.
class Renderer {
 public:
  Renderer(const World& world, const Camera& camera, const RenderOptions& options)
      : world_(world),
        camera_(camera),
        options_(options),
        integrator_(options.integrator->make(world, options.light)) {}

  /// The mean radiance over a pixel; adds the number of rays traced to `rays`.
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
  const LuminaireFactors& factors() const { return options_.light.factors; }

  Vec3f radiance(const Ray& ray, Random& random, uint64_t& rays) const {
    const TraceScene& surfaces = world_.surfaces();
    const bool total = options_.light.part == LightPart::total;
    Hit hit;
    rays++;
    if (!surfaces.intersect(ray, random, hit))
      return total ? hit.tint * factors().of(world_.lights().environment_luminaire()) *
                         world_.lights().environment().seen(ray.direction)
                   : Vec3f{};
    const Surface surface = surfaces.surface(hit);
    const Receiver receiver = Receiver::seen(surfaces, hit, surface, ray.direction);
    // What is unlit shows its colour, as in every viewer, and no light.
    if (surfaces.material(hit.instance).unlit)
      return total ? hit.tint * options_.display.radiance_of(surface.bsdf.diffuse) : Vec3f{};
    Vec3f sum = total ? factors().of(world_.lights().luminaire(hit)) * surfaces.emission(hit, surface) : Vec3f{};
    if (integrator_->samples()) {
      const ReflectedLight light = integrator_->sample(receiver, random);
      rays += static_cast<uint64_t>(light.rays);
      sum += light.radiance;
    }
    return hit.tint * (sum + integrator_->known(receiver));
  }

  const World& world_;
  const Camera& camera_;
  const RenderOptions& options_;
  std::unique_ptr<Integrator> integrator_;
};

Result<void> check(const RenderOptions& options) {
  if (options.width <= 0 || options.height <= 0) return fail("picture", "its size must be positive");
  if (options.samples <= 0) return fail("picture", "it needs at least one sample a pixel");
  if (options.integrator->needs_field && !options.light.field)
    return fail("picture", "there is no light grid to look up");
  return {};
}

}  // namespace

Result<Picture> render(const World& world, const Camera& camera, const RenderOptions& options, Progress& progress,
                       RenderStatistics& statistics) {
  LW_CHECK(check(options));
  const auto start = std::chrono::steady_clock::now();
  const Renderer renderer(world, camera, options);
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
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "picture", "cancelled");
  statistics.rays = rays;
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return picture;
}

}  // namespace lightwell
