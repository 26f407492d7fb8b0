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

}  // namespace

Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, const PackOptions& options, Progress& progress) {
  std::vector<int> refined;
  std::vector<const Mesh*> meshes;
  for (size_t i = 0; i < scene.primitives.size(); i++) {
    if (scene.primitives[i].deforming || scene.primitives[i].mesh.faces.empty()) continue;
    refined.push_back(static_cast<int>(i));
    meshes.push_back(&scene.primitives[i].mesh);
  }
  const std::vector<uint32_t> base_vertices = share_opening(meshes, options.opening_mesh_bytes);
  const std::vector<float> scales = largest_scales(scene);

  std::vector<std::optional<EncodedMesh>> encoded(meshes.size());
  std::mutex mutex;
  Result<void> outcome;
  size_t total = 0, done = 0;
  for (size_t i = 0; i < meshes.size(); i++)
    if (base_vertices[i] > 0) total += meshes[i]->positions.size();
  progress.stage("ordering meshes", static_cast<double>(total), "vertices");
  Cancellation cancellation(progress);
  parallel_for(meshes.size(), 1, options.threads, [&](size_t begin, size_t, int) {
    if (base_vertices[begin] == 0) return;
    SimplifyOptions simplify;
    simplify.base_vertices = base_vertices[begin];
    const float scale = scales[static_cast<size_t>(refined[begin])];
    if (options.position_error > 0 && scale > 0) simplify.quantize.position_error = options.position_error / scale;
    auto mesh = build_progressive(*meshes[begin], simplify, cancellation);
    if (mesh) encoded[begin] = encode(*mesh);
    const std::lock_guard lock(mutex);
    if (!mesh && outcome) outcome = fail(mesh.error());
    progress.advance(static_cast<double>(done += meshes[begin]->positions.size()));
  });
  LW_CHECK(outcome);

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
