// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_meshes.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "lightwell/base/parallel.h"
#include "lightwell/mesh/progressive.h"
#include "lightwell/packing/opening_budget.h"

namespace lightwell {
namespace {

// The largest factor by which any instance stretches the lengths of each primitive.
std::vector<float> largest_scales(const Scene& scene) {
  constexpr double largest = 1e30;  // keeps the product of error and scale finite
  std::vector<float> scales(scene.primitives.size(), 0);
  for (const Instance& instance : scene.instances) {
    const Transform& m = instance.to_scene;
    const double stretch = std::max({length(m.x), length(m.y), length(m.z)});
    float& scale = scales[static_cast<size_t>(instance.primitive)];
    scale = std::max(scale, static_cast<float>(std::min(stretch, largest)));
  }
  return scales;
}

// Forwards cancellation but not progress, since meshes simplified in parallel report as one stage.
class Cancellation : public Progress {
 public:
  explicit Cancellation(const Progress& user) : user_(user) {}
  bool cancelled() const override { return user_.cancelled(); }

 private:
  const Progress& user_;
};

// A level with fewer vertices shows nothing of a shape.
constexpr uint32_t fewest_vertices = 8;

// The primitives that a stream can refine.
std::vector<int> refined_primitives(const Scene& scene) {
  std::vector<int> refined;
  for (size_t i = 0; i < scene.primitives.size(); i++)
    if (!scene.primitives[i].deforming && !scene.primitives[i].mesh.faces.empty())
      refined.push_back(static_cast<int>(i));
  return refined;
}

// Reports the progress of meshes processed in parallel. Every vertex counts twice: when simplified and when encoded.
class SharedCount {
 public:
  SharedCount(Progress& progress, size_t total) : progress_(progress) {
    progress_.stage("ordering meshes", static_cast<double>(total), "vertices");
  }
  void add(size_t vertices) {
    const std::lock_guard lock(mutex_);
    progress_.advance(static_cast<double>(done_ += vertices) / 2);
  }

 private:
  Progress& progress_;
  std::mutex mutex_;
  size_t done_ = 0;
};

SimplifyOptions simplify_options(const PackOptions& options, float scale) {
  SimplifyOptions simplify;
  simplify.base_vertices = fewest_vertices;
  if (options.position_error > 0 && scale > 0) simplify.quantize.position_error = options.position_error / scale;
  return simplify;
}

}  // namespace

Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, const PackOptions& options, Progress& progress) {
  const std::vector<int> refined = refined_primitives(scene);
  const std::vector<float> scales = largest_scales(scene);
  const auto mesh_of = [&](size_t i) -> const Mesh& { return scene.primitives[static_cast<size_t>(refined[i])].mesh; };
  const auto scale_of = [&](size_t i) { return scales[static_cast<size_t>(refined[i])]; };
  size_t total = 0;
  for (size_t i = 0; i < refined.size(); i++) total += mesh_of(i).positions.size();
  SharedCount count(progress, total);
  Cancellation cancellation(progress);

  std::vector<std::optional<SimplifiedMesh>> simplified(refined.size());
  std::vector<Result<void>> outcomes(refined.size());
  std::vector<std::vector<OpeningForm>> forms(refined.size());
  parallel_for(refined.size(), 1, options.threads, [&](size_t i, size_t, int) {
    auto mesh = simplify(mesh_of(i), simplify_options(options, scale_of(i)), cancellation);
    if (!mesh) {
      outcomes[i] = fail(mesh.error());
      return;
    }
    forms[i] = opening_forms(mesh_of(i), *mesh, scale_of(i));
    simplified[i] = std::move(*mesh);
    count.add(mesh_of(i).positions.size());
  });
  for (Result<void>& outcome : outcomes) LW_CHECK(outcome);

  const std::vector<size_t> rounds =
      share_opening(forms, OpeningBudget::of(refined.size(), length(scene.bounds().size())));
  std::vector<std::optional<EncodedMesh>> encoded(refined.size());
  parallel_for(refined.size(), 1, options.threads, [&](size_t i, size_t, int) {
    if (rounds[i] > 0 && !progress.cancelled()) {
      const ProgressiveMesh mesh = refine_after(std::move(*simplified[i]), rounds[i]);
      encoded[i] = encode(mesh);
    }
    simplified[i].reset();
    count.add(mesh_of(i).positions.size());
  });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "meshes", "cancelled");

  std::vector<StreamedMesh> streamed;
  // A mesh of degenerate faces only has no coarsest level and stays whole in the opening.
  for (size_t i = 0; i < encoded.size(); i++)
    if (encoded[i] && !encoded[i]->blocks.empty() && !encoded[i]->base.faces.empty())
      streamed.push_back({refined[i], std::move(*encoded[i])});
  auto seen_error = [&](const StreamedMesh& mesh) {
    return mesh.encoded.layout.base_error * scales[static_cast<size_t>(mesh.primitive)];
  };
  std::stable_sort(streamed.begin(), streamed.end(),
                   [&](const StreamedMesh& a, const StreamedMesh& b) { return seen_error(a) > seen_error(b); });
  return streamed;
}

}  // namespace lightwell
