// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_meshes.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <set>

#include "lightwell/base/parallel.h"
#include "lightwell/gltf/pose.h"
#include "lightwell/mesh/part_table.h"
#include "lightwell/mesh/progressive.h"

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

// A primitive that a stream can refine.
struct Source {
  int primitive = 0;
  float scale = 0;  // the largest factor by which an instance, or its pose, stretches its lengths
  const Mesh* posed = nullptr;
  std::optional<DeformingMesh> deforming = {};
  const MergedMesh* merged = nullptr;

  const Mesh& mesh() const { return deforming ? deforming->mesh : *posed; }
};

std::optional<DeformingMesh> deforming_mesh(const Scene& scene, const Primitive& primitive) {
  Report known;
  auto rest = read_at_rest(scene.document, primitive.source_mesh, primitive.source_primitive, known);
  if (!rest) return {};
  const Json& json = scene.document.json["meshes"][static_cast<size_t>(primitive.source_mesh)]["primitives"]
                                        [static_cast<size_t>(primitive.source_primitive)];
  const Json& positions =
      element(scene.document.json["accessors"], static_cast<size_t>(index_of(json["attributes"], "POSITION")));
  auto deformation = Deformation::read(scene.document, json, static_cast<size_t>(number(positions, "count", 0)), "");
  if (!deformation) return {};
  const std::vector<uint32_t> first = deformation->first_alike();
  for (uint32_t& row : rest->rows) row = first[row];
  return DeformingMesh{std::move(rest->mesh), std::move(*deformation), std::move(rest->rows)};
}

// What deforms is there once, whatever poses it is shown in, and stays whole where its arrays are not as they should
// be.
std::vector<Source> sources(const Scene& scene, const std::optional<MergedParts>& merged) {
  const std::vector<float> scales = largest_scales(scene);
  std::set<std::pair<int, int>> seen;
  std::vector<Source> found;
  for (size_t i = 0; i < scene.primitives.size(); i++) {
    const Primitive& primitive = scene.primitives[i];
    if (primitive.mesh.faces.empty()) continue;
    Source source{static_cast<int>(i), scales[i], &primitive.mesh};
    if (merged && i >= merged->first_primitive) source.merged = &merged->meshes[i - merged->first_primitive];
    if (primitive.deforming) {
      if (!seen.emplace(primitive.source_mesh, primitive.source_primitive).second) continue;
      source.deforming = deforming_mesh(scene, primitive);
      if (!source.deforming) continue;
      const float rest = length(source.mesh().bounds().size()), posed = length(primitive.mesh.bounds().size());
      if (rest > 0 && posed > 0) source.scale *= posed / rest;
    }
    found.push_back(std::move(source));
  }
  return found;
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

SimplifyOptions simplify_options(const PackOptions& options, const Source& source) {
  SimplifyOptions simplify;
  simplify.base_vertices = fewest_vertices;
  if (options.position_error > 0 && source.scale > 0)
    simplify.quantize.position_error = options.position_error / source.scale;
  if (source.deforming) simplify.quantize.rows = source.deforming->rows;
  if (!source.merged) return simplify;
  simplify.quantize.rows = source.merged->part_of_vertex;
  if (options.position_error <= 0) simplify.quantize.position_error = usual_position_error(source.merged->part_size);
  return simplify;
}

}  // namespace

Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, std::optional<MergedParts>& merged,
                                                const OpeningBudget& budget, const PackOptions& options,
                                                Progress& progress) {
  std::vector<Source> refined = sources(scene, merged);
  size_t total = 0;
  for (const Source& source : refined) total += source.mesh().positions.size();
  SharedCount count(progress, total);
  Cancellation cancellation(progress);

  std::vector<std::optional<SimplifiedMesh>> simplified(refined.size());
  std::vector<Result<void>> outcomes(refined.size());
  std::vector<std::vector<OpeningForm>> forms(refined.size());
  parallel_for(refined.size(), 1, options.threads, [&](size_t i, size_t, int) {
    const Mesh& source = refined[i].mesh();
    auto mesh = simplify(source, simplify_options(options, refined[i]), cancellation);
    if (!mesh) {
      outcomes[i] = fail(mesh.error());
      return;
    }
    forms[i] = opening_forms(source, *mesh, refined[i].scale);
    simplified[i] = std::move(*mesh);
    count.add(source.positions.size());
  });
  for (Result<void>& outcome : outcomes) LW_CHECK(outcome);

  const std::vector<size_t> rounds = share_opening(forms, budget);
  std::vector<std::optional<EncodedMesh>> encoded(refined.size());
  std::vector<std::vector<uint32_t>> tables(refined.size());  // of those that are merged and streamed
  parallel_for(refined.size(), 1, options.threads, [&](size_t i, size_t, int) {
    if (rounds[i] > 0 && !progress.cancelled()) {
      ProgressiveMesh mesh = refine_after(std::move(*simplified[i]), rounds[i]);
      encoded[i] = encode(mesh);
      if (refined[i].merged) tables[i] = part_table(dequantize(mesh.mesh), mesh.mesh.rows);
      if (refined[i].deforming) refined[i].deforming->rows = std::move(mesh.mesh.rows);
    }
    simplified[i].reset();
    count.add(refined[i].mesh().positions.size());
  });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "meshes", "cancelled");

  std::vector<std::pair<float, StreamedMesh>> streamed;  // with its error, metres
  // A mesh of degenerate faces only has no coarsest level and stays whole in the opening.
  for (size_t i = 0; i < encoded.size(); i++) {
    const bool is_streamed = encoded[i] && !encoded[i]->blocks.empty() && !encoded[i]->base.faces.empty();
    if (const MergedMesh* parts = refined[i].merged) {
      if (!is_streamed) tables[i] = part_table(refined[i].mesh(), parts->part_of_vertex);
      merged->file.merged[static_cast<size_t>(parts - merged->meshes.data())].table = std::move(tables[i]);
    }
    if (!is_streamed) continue;
    const float error = encoded[i]->layout.base_error * refined[i].scale;
    const Box3f bounds = refined[i].mesh().bounds();
    streamed.push_back(
        {error, {refined[i].primitive, std::move(*encoded[i]), bounds, std::move(refined[i].deforming)}});
  }
  std::stable_sort(streamed.begin(), streamed.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<StreamedMesh> sorted;
  for (auto& [error, mesh] : streamed) sorted.push_back(std::move(mesh));
  return sorted;
}

}  // namespace lightwell
