// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
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

// What a stream can refine: a primitive, or several as the regions of one mesh.
struct Source {
  MeshGroup primitives;
  float scale = 0;  // the largest factor by which an instance, or its pose, stretches its lengths
  size_t vertices = 0;
  bool counted = false;         // as simplified
  const Mesh* posed = nullptr;  // of the first
  std::optional<DeformingMesh> deforming = {};

  bool has_regions() const { return primitives.size() > 1; }
  /// Where it has no regions.
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

Source source_of(const Scene& scene, const std::vector<float>& scales, const MeshGroup& group) {
  Source source{group, 0, 0, false, &scene.primitives[static_cast<size_t>(group[0])].mesh};
  for (const int primitive : group) {
    source.scale = std::max(source.scale, scales[static_cast<size_t>(primitive)]);
    source.vertices += scene.primitives[static_cast<size_t>(primitive)].mesh.positions.size();
  }
  return source;
}

// What deforms is there once, whatever poses it is shown in, and stays whole where its arrays are not as they should
// be.
std::vector<Source> sources(const Scene& scene, const std::vector<float>& scales, std::span<const MeshGroup> groups) {
  std::set<std::pair<int, int>> seen;
  std::vector<Source> found;
  for (const MeshGroup& group : groups) found.push_back(source_of(scene, scales, group));
  for (size_t i = 0; i < scene.primitives.size(); i++) {
    const Primitive& primitive = scene.primitives[i];
    if (primitive.mesh.faces.empty() || !primitive.deforming) continue;
    if (!seen.emplace(primitive.source_mesh, primitive.source_primitive).second) continue;
    Source source = source_of(scene, scales, {static_cast<int>(i)});
    source.deforming = deforming_mesh(scene, primitive);
    if (!source.deforming) continue;
    const float rest = length(source.mesh().bounds().size()), posed = length(primitive.mesh.bounds().size());
    if (rest > 0 && posed > 0) source.scale *= posed / rest;
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

const MergedMesh* merged_mesh(const std::optional<MergedParts>& merged, int primitive) {
  const auto index = static_cast<size_t>(primitive);
  return merged && index >= merged->first_primitive ? &merged->meshes[index - merged->first_primitive] : nullptr;
}

// What of a source the quantisation has to know beside its mesh.
struct Quantities {
  QuantizeOptions options;
  std::vector<uint32_t> rows;
  std::vector<float> errors;  // of each region
};

Quantities quantities(const Source& source, const UnitedMesh& united, std::span<const float> errors,
                      const std::optional<MergedParts>& merged, const PackOptions& options) {
  Quantities out;
  if (source.deforming) out.rows = source.deforming->rows;
  for (const int primitive : source.primitives) {
    out.errors.push_back(errors[static_cast<size_t>(primitive)]);
    const MergedMesh* parts = merged_mesh(merged, primitive);
    if (parts) out.rows.insert(out.rows.end(), parts->part_of_vertex.begin(), parts->part_of_vertex.end());
    // Else what is usual for its mesh. What deforms has the scale of its pose.
    if (options.position_error > 0)
      out.options.position_error = source.scale > 0 ? options.position_error / source.scale : 0;
    else if (parts)
      out.options.position_error = out.errors.back();
  }
  out.options.rows = out.rows;
  out.options.regions = united.region_of_vertex;
  if (source.has_regions()) out.options.region_errors = out.errors;
  return out;
}

// Of each region whether the coarsest level has a face of it, which its array in the opening needs: not where two
// corners of each of its faces lie at one place of the lattice.
std::vector<bool> shown_regions(const SimplifiedMesh& simplified) {
  std::vector<bool> shown(simplified.mesh.region_shifts.size());
  for (size_t f = 0; f < simplified.mesh.regions.size(); f++)
    if (simplified.order.vanished[f] != CollapseOrder::loose) shown[simplified.mesh.regions[f]] = true;
  return shown;
}

// The groups that a group falls apart into when each region that is not shown is alone.
std::vector<MeshGroup> divided(const MeshGroup& group, const std::vector<bool>& shown) {
  std::vector<MeshGroup> groups;
  MeshGroup together;
  for (size_t i = 0; i < group.size(); i++)
    if (shown[i])
      together.push_back(group[i]);
    else
      groups.push_back({group[i]});
  if (!together.empty()) groups.push_back(std::move(together));
  return groups;
}

// Sources with their orders of collapse.
struct Simplified {
  std::vector<Source> sources;
  std::vector<std::optional<SimplifiedMesh>> meshes;
  std::vector<std::vector<OpeningForm>> forms;
};

Result<Simplified> simplify_all(const Scene& scene, std::span<const MeshGroup> groups, std::span<const float> errors,
                                const std::optional<MergedParts>& merged, const PackOptions& options,
                                SharedCount& count, Progress& progress) {
  Cancellation cancellation(progress);
  const std::vector<float> scales = largest_scales(scene);
  Simplified out;
  for (std::vector<Source> left = sources(scene, scales, groups); !left.empty();) {
    std::vector<std::vector<OpeningForm>> forms(left.size());
    std::vector<std::optional<SimplifiedMesh>> meshes(left.size());
    std::vector<Result<void>> outcomes(left.size());
    parallel_for(left.size(), 1, options.threads, [&](size_t i, size_t, int) {
      if (!left[i].counted) count.add(left[i].vertices);
      const UnitedMesh regions = left[i].has_regions() ? united(scene, left[i].primitives) : UnitedMesh();
      const Mesh& source = left[i].has_regions() ? regions.mesh : left[i].mesh();
      const Quantities wanted = quantities(left[i], regions, errors, merged, options);
      const auto fewest = fewest_vertices * static_cast<uint32_t>(left[i].primitives.size());
      auto mesh = simplify(source, {wanted.options, fewest}, cancellation);
      if (!mesh) {
        outcomes[i] = fail(mesh.error());
        return;
      }
      forms[i] = opening_forms(source, *mesh, left[i].scale);
      meshes[i] = std::move(*mesh);
    });
    for (Result<void>& outcome : outcomes) LW_CHECK(outcome);
    std::vector<Source> again;
    for (size_t i = 0; i < left.size(); i++) {
      const std::vector<bool> shown = shown_regions(*meshes[i]);
      if (!std::ranges::all_of(shown, std::identity())) {
        for (const MeshGroup& group : divided(left[i].primitives, shown))
          again.push_back(source_of(scene, scales, group));
        for (Source& piece : again) piece.counted = true;
        continue;
      }
      out.forms.push_back(std::move(forms[i]));
      out.meshes.push_back(std::move(meshes[i]));
      out.sources.push_back(std::move(left[i]));
    }
    left = std::move(again);
  }
  return out;
}

// The least box of few decimals around a box.
Box3f rounded_outwards(Box3f box) {
  const double digit = std::pow(10.0, std::floor(std::log10(std::max(1e-30f, max_component(box.size())))) - 3);
  for (int i = 0; i < 3; i++) {
    box.lo[i] = std::min(box.lo[i], static_cast<float>(std::floor(box.lo[i] / digit) * digit));
    box.hi[i] = std::max(box.hi[i], static_cast<float>(std::ceil(box.hi[i] / digit) * digit));
  }
  return box;
}

// Of each region the bounds at all levels: at coarse ones its faces may have corners at the vertices of others.
std::vector<Box3f> bounds_of_regions(const ProgressiveMesh& mesh, const Mesh& final_level) {
  std::vector<Box3f> bounds(mesh.mesh.region_shifts.size());
  for (size_t f = 0; f < mesh.mesh.regions.size(); f++)
    for (uint32_t v : mesh.mesh.faces[f]) {
      Box3f& box = bounds[mesh.mesh.regions[f]];
      box.extend(final_level.positions[v]);
      if (f >= mesh.appears_with.size()) continue;  // loose
      const uint32_t first = std::max(mesh.appears_with[f] + 1, mesh.base_vertices());
      while (v >= first) box.extend(final_level.positions[v = mesh.parent[v]]);
    }
  for (Box3f& box : bounds) box = rounded_outwards(box);
  return bounds;
}

// The table that tells of a merged primitive's faces to which part each belongs.
std::vector<uint32_t> table_of(const ProgressiveMesh& mesh, const Mesh& final_level, size_t region) {
  if (mesh.mesh.regions.empty()) return part_table(final_level, mesh.mesh.rows);
  std::vector<Face> faces;
  std::vector<bool> used(mesh.mesh.positions.size());
  for (size_t f = 0; f < mesh.mesh.faces.size(); f++) {
    if (mesh.mesh.regions[f] != region) continue;
    faces.push_back(mesh.mesh.faces[f]);
    for (const uint32_t v : faces.back()) used[v] = true;
  }
  std::vector<uint32_t> rows;
  for (size_t v = 0; v < used.size(); v++)
    if (used[v]) rows.push_back(mesh.mesh.rows[v]);
  return part_table(mesh_of_faces(final_level, std::move(faces)), rows);
}

}  // namespace

PositionErrors position_errors(const Scene& scene, const std::optional<MergedParts>& merged,
                               const PackOptions& options) {
  constexpr float usual_slack = 16, steps_of_a_form = 64;
  const std::vector<float> scales = largest_scales(scene);
  PositionErrors errors;
  for (size_t i = 0; i < scene.primitives.size(); i++) {
    const MergedMesh* parts = merged_mesh(merged, static_cast<int>(i));
    const float side = parts ? parts->part_size : max_component(scene.primitives[i].mesh.bounds().size());
    const bool said = options.position_error > 0 && scales[i] > 0;
    // A primitive keeps its form however large the error is that is asked for.
    const float largest = 0.5f * side / steps_of_a_form;
    errors.wanted.push_back(said ? std::min(options.position_error / scales[i], largest) : usual_position_error(side));
    errors.most.push_back(errors.wanted.back() * (said || parts ? 1 : usual_slack));
  }
  return errors;
}

Result<std::vector<StreamedMesh>> encode_meshes(const Scene& scene, std::span<const MeshGroup> groups,
                                                std::span<const float> errors, std::optional<MergedParts>& merged,
                                                const OpeningBudget& budget, const PackOptions& options,
                                                Progress& progress) {
  size_t total = 0;
  for (const Primitive& primitive : scene.primitives) total += primitive.mesh.positions.size();
  SharedCount count(progress, total);
  LW_TRY(ordered, simplify_all(scene, groups, errors, merged, options, count, progress));
  std::vector<Source>& refined = ordered.sources;
  std::vector<std::optional<SimplifiedMesh>>& simplified = ordered.meshes;

  const std::vector<size_t> rounds = share_opening(ordered.forms, budget);
  std::vector<std::optional<EncodedMesh>> encoded(refined.size());
  std::vector<std::vector<Box3f>> bounds(refined.size());
  std::vector<std::vector<uint32_t>> tables(scene.primitives.size());  // of those that are merged
  parallel_for(refined.size(), 1, options.threads, [&](size_t i, size_t, int) {
    if (rounds[i] > 0 && !progress.cancelled()) {
      ProgressiveMesh mesh = refine_after(std::move(*simplified[i]), rounds[i]);
      encoded[i] = encode(mesh);
      const bool is_merged = merged_mesh(merged, refined[i].primitives[0]);
      const Mesh final_level = refined[i].has_regions() || is_merged ? dequantize(mesh.mesh) : Mesh();
      if (refined[i].has_regions()) bounds[i] = bounds_of_regions(mesh, final_level);
      for (size_t region = 0; region < refined[i].primitives.size(); region++)
        if (const int primitive = refined[i].primitives[region]; merged_mesh(merged, primitive))
          tables[static_cast<size_t>(primitive)] = table_of(mesh, final_level, region);
      if (refined[i].deforming) refined[i].deforming->rows = std::move(mesh.mesh.rows);
    }
    simplified[i].reset();
    count.add(refined[i].vertices);
  });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "meshes", "cancelled");

  std::vector<std::pair<float, StreamedMesh>> streamed;  // with its error, metres
  // A mesh of degenerate faces only has no coarsest level and stays whole in the opening.
  for (size_t i = 0; i < encoded.size(); i++) {
    const bool is_streamed = encoded[i] && !encoded[i]->blocks.empty() && !encoded[i]->base.faces.empty();
    for (const int primitive : refined[i].primitives) {
      const auto index = static_cast<size_t>(primitive);
      const Mesh& mesh = refined[i].deforming ? refined[i].mesh() : scene.primitives[index].mesh;
      if (!refined[i].has_regions()) bounds[i].push_back(mesh.bounds());
      const MergedMesh* parts = merged_mesh(merged, primitive);
      if (!parts) continue;
      if (!is_streamed) tables[index] = part_table(mesh, parts->part_of_vertex);
      merged->file.merged[static_cast<size_t>(parts - merged->meshes.data())].table = std::move(tables[index]);
    }
    if (!is_streamed) continue;
    const float error = encoded[i]->layout.base_error * refined[i].scale;
    streamed.push_back({error,
                        {std::move(refined[i].primitives), std::move(*encoded[i]), std::move(bounds[i]),
                         std::move(refined[i].deforming)}});
  }
  std::stable_sort(streamed.begin(), streamed.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<StreamedMesh> sorted;
  for (auto& [error, mesh] : streamed) sorted.push_back(std::move(mesh));
  return sorted;
}

}  // namespace lightwell
