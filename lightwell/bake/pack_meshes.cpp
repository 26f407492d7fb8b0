// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/pack_meshes.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "lightwell/bake/opening_budget.h"
#include "lightwell/base/parallel.h"
#include "lightwell/mesh/progressive.h"

namespace lightwell {
namespace {

// The largest factor by which an instance of each primitive stretches lengths.
std::vector<float> largest_scales(const Scene& scene) {
  std::vector<float> scales(scene.primitives.size(), 0);
  for (const Instance& instance : scene.instances) {
    const Transform& m = instance.to_scene;
    const double stretch = std::max({length(m.x), length(m.y), length(m.z)});
    float& scale = scales[static_cast<size_t>(instance.primitive)];
    scale = std::max(scale, static_cast<float>(stretch));
  }
  return scales;
}

// Meshes are encoded side by side and report as one stage; each of them tells of its own steps to nobody.
class Cancellation : public Progress {
 public:
  explicit Cancellation(const Progress& user) : user_(user) {}
  bool cancelled() const override { return user_.cancelled(); }

 private:
  const Progress& user_;
};

// A coarser level shows nothing of a shape.
constexpr uint32_t fewest_vertices = 8;

// The primitives that a stream can refine.
std::vector<int> refined_primitives(const Scene& scene) {
  std::vector<int> refined;
  for (size_t i = 0; i < scene.primitives.size(); i++)
    if (!scene.primitives[i].deforming && !scene.primitives[i].mesh.faces.empty())
      refined.push_back(static_cast<int>(i));
  return refined;
}

Result<std::vector<SimplifiedMesh>> simplify_all(const Scene& scene, const std::vector<int>& refined,
                                                 const std::vector<float>& scales, const PackOptions& options,
                                                 Progress& progress) {
  std::vector<std::optional<SimplifiedMesh>> simplified(refined.size());
  std::mutex mutex;
  Result<void> outcome;
  size_t total = 0, done = 0;
  for (const int primitive : refined) total += scene.primitives[static_cast<size_t>(primitive)].mesh.positions.size();
  progress.stage("ordering meshes", static_cast<double>(total), "vertices");
  Cancellation cancellation(progress);
  parallel_for(refined.size(), 1, options.threads, [&](size_t i, size_t, int) {
    const auto primitive = static_cast<size_t>(refined[i]);
    const Mesh& mesh = scene.primitives[primitive].mesh;
    SimplifyOptions simplify_options;
    simplify_options.base_vertices = fewest_vertices;
    if (options.position_error > 0 && scales[primitive] > 0)
      simplify_options.quantize.position_error = options.position_error / scales[primitive];
    auto result = simplify(mesh, simplify_options, cancellation);
    const std::lock_guard lock(mutex);
    if (result)
      simplified[i].emplace(std::move(*result));
    else if (outcome)
      outcome = fail(result.error());
    progress.advance(static_cast<double>(done += mesh.positions.size()));
  });
  LW_CHECK(outcome);
  std::vector<SimplifiedMesh> all;
  for (std::optional<SimplifiedMesh>& mesh : simplified) all.push_back(std::move(*mesh));
  return all;
}

}  // namespace

Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, const PackOptions& options, Progress& progress) {
  const std::vector<int> refined = refined_primitives(scene);
  const std::vector<float> scales = largest_scales(scene);
  LW_TRY(simplified, simplify_all(scene, refined, scales, options, progress));

  std::vector<std::vector<OpeningForm>> forms;
  for (size_t i = 0; i < refined.size(); i++) {
    const auto primitive = static_cast<size_t>(refined[i]);
    forms.push_back(opening_forms(scene.primitives[primitive].mesh, simplified[i], scales[primitive]));
  }
  const std::vector<size_t> rounds =
      share_opening(forms, OpeningBudget::of(refined.size(), length(scene.bounds().size())));

  std::vector<std::optional<EncodedMesh>> encoded(refined.size());
  parallel_for(refined.size(), 1, options.threads, [&](size_t i, size_t, int) {
    if (rounds[i] == 0) return;
    const ProgressiveMesh mesh = refine_after(std::move(simplified[i]), rounds[i]);
    encoded[i] = encode(mesh);
  });

  std::vector<StreamedMesh> streamed;
  // A mesh of degenerate faces only has no coarsest level: it stays in the opening as it is.
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
