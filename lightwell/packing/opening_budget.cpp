// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/opening_budget.h"

#include <algorithm>
#include <queue>

#include "lightwell/mesh/vertex_codes.h"
#include "lightwell/pack/directory.h"

namespace lightwell {
namespace {

// Bytes of a primitive and its arrays in the JSON; measured on scenes of up to a hundred of them.
constexpr uint64_t primitive_bytes = 400;
// And of one that shares all arrays but its indices with others.
constexpr uint64_t region_bytes = 260;

// Of a stream in JSON and directory, which has a row for each of its first blocks.
uint64_t stream_bytes(size_t vertices) {
  constexpr uint64_t without_rows = 250, vertices_of_a_block = 400;
  return without_rows + row_bytes * std::clamp<uint64_t>(vertices / vertices_of_a_block, 8, rows_per_page);
}

uint64_t bytes_per_vertex(const Mesh& mesh) {
  uint64_t bytes = sizeof(Vec3f);
  if (!mesh.normals.empty()) bytes += sizeof(Vec3f);
  for (const auto& set : mesh.texcoords)
    if (!set.empty()) bytes += sizeof(Vec2f);
  if (!mesh.colors.empty()) bytes += sizeof(Color16);
  return bytes;
}

uint64_t opening_bytes(const Mesh& mesh, size_t vertices, size_t faces) {
  const uint64_t bytes_per_index = vertices > 65535 ? 4 : 2;
  return bytes_per_vertex(mesh) * vertices + 3 * bytes_per_index * faces;
}

// Whether a streamed form is hardly smaller than the whole mesh. A stream also costs a request and the bytes of its
// blocks.
bool saves_little(const std::vector<OpeningForm>& forms, size_t form) {
  constexpr uint64_t stream_worth_bytes = 1500;
  return forms.front().bytes <= forms[form].bytes + stream_worth_bytes;
}

// The next finer form that has a smaller error; the form itself if there is none.
size_t next_better(const std::vector<OpeningForm>& forms, size_t form) {
  size_t finer = form;
  while (finer > 0 && forms[finer].error >= forms[form].error) finer--;
  return forms[finer].error < forms[form].error ? finer : form;
}

}  // namespace

std::vector<OpeningForm> opening_forms(const Mesh& mesh, const SimplifiedMesh& simplified, float scale) {
  const std::vector<SimplifiedMesh::Level> levels = simplified.levels();
  const uint64_t regions = std::max<uint64_t>(1, simplified.mesh.region_shifts.size());
  const uint64_t whole = opening_bytes(mesh, mesh.positions.size(), mesh.faces.size());
  std::vector<OpeningForm> forms = {{regions * primitive_bytes + whole, 0}};
  const uint64_t json = primitive_bytes + (regions - 1) * region_bytes + stream_bytes(mesh.positions.size());
  for (size_t i = 1; i < levels.size(); i++)
    forms.push_back({json + opening_bytes(mesh, levels[i].vertices, levels[i].faces), levels[i].error * scale});
  return forms;
}

OpeningBudget OpeningBudget::of(size_t meshes, size_t more_regions, float scene_size) {
  constexpr uint64_t usual = 40 << 10, most = 256 << 10, each = 1536, each_region = 1100;
  return {usual, std::clamp<uint64_t>(each * meshes + each_region * more_regions, usual, most), scene_size / 50};
}

OpeningBudget OpeningBudget::beside(uint64_t rest) {
  constexpr uint64_t request = 62 << 10, least = 40 << 10;
  const uint64_t left = std::max(least, request - std::min(request, rest));
  return {left, left, 0};
}

std::vector<size_t> share_opening(const std::vector<std::vector<OpeningForm>>& meshes, const OpeningBudget& budget) {
  std::vector<size_t> chosen;
  uint64_t taken = 0;
  std::priority_queue<std::pair<float, size_t>> by_error;
  for (size_t i = 0; i < meshes.size(); i++) {
    const std::vector<OpeningForm>& forms = meshes[i];
    chosen.push_back(saves_little(forms, forms.size() - 1) ? 0 : forms.size() - 1);
    taken += forms[chosen[i]].bytes;
    by_error.emplace(forms[chosen[i]].error, i);
  }
  while (!by_error.empty()) {
    const size_t i = by_error.top().second;
    by_error.pop();
    const std::vector<OpeningForm>& forms = meshes[i];
    const uint64_t others = taken - forms[chosen[i]].bytes;
    const uint64_t limit = forms[chosen[i]].error > budget.likeness ? budget.bytes_for_likeness : budget.bytes;
    const auto fits = [&](size_t form) { return others + forms[form].bytes <= std::max(limit, taken); };
    size_t next = next_better(forms, chosen[i]);
    if (saves_little(forms, next) && fits(0)) next = 0;
    if (next == chosen[i] || !fits(next)) continue;
    taken = others + forms[next].bytes;
    chosen[i] = next;
    by_error.emplace(forms[next].error, i);
  }
  return chosen;
}

}  // namespace lightwell
