// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/render.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "lightwell/base/parallel.h"
#include "lightwell/render/camera.h"

namespace lightwell {
namespace {

/// What a pixel is the mean of.
struct PixelSamples {
  Random random;
  Vec3d sum{};
  int count = 0;

  Vec3f mean() const { return (sum / count).cast<float>(); }
};

/// Takes samples of the pixels of a picture.
class Renderer {
 public:
  Renderer(const World& world, const Camera& camera, const RenderOptions& options)
      : world_(world),
        camera_(camera),
        options_(options),
        integrator_(options.integrator->make(world, options.light)) {}

  PixelSamples begin(size_t pixel) const { return {.random = Random(options_.seed, pixel)}; }

  /// Adds samples of the radiance over a pixel. Returns the number of rays traced.
  uint64_t add(int samples, int x, int y, PixelSamples& pixel) const {
    const float width = static_cast<float>(options_.width), height = static_cast<float>(options_.height);
    uint64_t rays = 0;
    for (int i = 0; i < samples; i++) {
      const float u = (static_cast<float>(x) + pixel.random.uniform()) / width;
      const float v = (static_cast<float>(y) + pixel.random.uniform()) / height;
      pixel.sum += radiance(camera_ray(camera_, width / height, u, v), pixel.random, rays).cast<double>();
    }
    pixel.count += samples;
    return rays;
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

/// A picture, better with each pass over it.
class Passes {
 public:
  Passes(const World& world, const Camera& camera, const RenderOptions& options, Progress& progress)
      : options_(options), progress_(progress), renderer_(world, camera, options) {
    const size_t width = static_cast<size_t>(options.width), height = static_cast<size_t>(options.height);
    picture_.pixels.resize(3 * width * height);
    if (options.seconds) {
      kept_.reserve(width * height);
      for (size_t i = 0; i < width * height; i++) kept_.push_back(renderer_.begin(i));
      progress.stage("picture", *options.seconds, "");
    } else {
      progress.stage("picture", static_cast<double>(height), "rows");
    }
  }

  /// Takes passes until there are as many samples or as much time has passed as is wanted.
  void take() {
    do pass(options_.seconds ? 1 : options_.samples);
    while (!progress_.cancelled() && samples_ < options_.samples && another_fits());
  }

  Picture& picture() { return picture_; }
  RenderStatistics statistics() const { return {.seconds = seconds(), .rays = rays_, .samples = samples_}; }

 private:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  bool another_fits() const { return seconds() * (samples_ + 1) / samples_ <= *options_.seconds; }

  void pass(int samples) {
    std::atomic<size_t> done = 0;
    parallel_for(
        static_cast<size_t>(options_.height), 1, options_.threads,
        [&](size_t begin, size_t end, int) {
          for (size_t y = begin; y < end; y++) add_to_row(samples, y);
          done += end - begin;
          progress_.advance(options_.seconds ? std::min(seconds(), *options_.seconds) : static_cast<double>(done));
        },
        [&] { return progress_.cancelled(); });
    samples_ += samples;
  }

  void add_to_row(int samples, size_t y) {
    const size_t width = static_cast<size_t>(options_.width);
    uint64_t rays = 0;
    for (size_t x = 0; x < width; x++) {
      const size_t i = y * width + x;
      PixelSamples fresh = renderer_.begin(i);
      PixelSamples& pixel = kept_.empty() ? fresh : kept_[i];
      rays += renderer_.add(samples, static_cast<int>(x), static_cast<int>(y), pixel);
      std::ranges::copy(pixel.mean().e, picture_.pixels.begin() + static_cast<ptrdiff_t>(3 * i));
    }
    rays_ += rays;
  }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const RenderOptions& options_;
  Progress& progress_;
  const Renderer renderer_;
  std::vector<PixelSamples> kept_;  // of all pixels, if there is more than one pass
  Picture picture_{options_.width, options_.height, {}};
  std::atomic<uint64_t> rays_ = 0;
  int samples_ = 0;  // a pixel
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
  Passes passes(world, camera, options, progress);
  passes.take();
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "picture", "cancelled");
  statistics = passes.statistics();
  return std::move(passes.picture());
}

}  // namespace lightwell
