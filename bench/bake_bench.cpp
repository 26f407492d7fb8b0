// SPDX-License-Identifier: Apache-2.0
//
// bake_bench FOLDER: what the estimators err by for their processor time, in the rooms of a folder whose irradiance
// another renderer has measured: ROOM.glb, ROOM.free.indirect.csv and ROOM.surf.indirect.csv.
#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>

#include "lightwell/bake/light_bake.h"
#include "lightwell/bake/photon_estimator.h"
#include "lightwell/scene/scene.h"

namespace lightwell {
namespace {

struct Measured {
  Vec3f position{}, normal{}, irradiance{};
};

/// Rows of x,y,z,nx,ny,nz,r,g,b,… below a line of names.
std::vector<Measured> read_points(const std::string& path) {
  std::vector<Measured> points;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    Measured point;
    for (Vec3f* v : {&point.position, &point.normal, &point.irradiance})
      for (float& x : v->e) numbers >> x;
    points.push_back(point);
  }
  return points;
}

/// Root mean square error, % of the mean. The measured values' own noise, some 0.6 %, is in it.
double error_of(const LightField& field, const std::vector<Measured>& points) {
  double squares = 0, sum = 0;
  for (const Measured& point : points) {
    const Vec3f off = field.irradiance(point.position, point.normal, point.normal) - point.irradiance;
    squares += static_cast<double>(dot(off, off));
    sum += static_cast<double>(point.irradiance[0] + point.irradiance[1] + point.irradiance[2]);
  }
  const double count = 3 * static_cast<double>(points.size());
  return 100 * std::sqrt(squares / count) / (sum / count);
}

struct Candidate {
  const EstimatorKind* kind;
  uint64_t photons;
};

bool compare(const std::string& folder, const char* room, const std::vector<Candidate>& candidates) {
  Report report;
  const auto scene = load_scene(folder + '/' + room + ".glb", {}, report);
  const auto world = scene ? World::build(*scene) : fail(scene.error());
  if (!world) return std::fprintf(stderr, "%s\n", world.error().message().c_str()), false;
  const auto free = read_points(folder + '/' + room + ".free.indirect.csv");
  const auto surfaces = read_points(folder + '/' + room + ".surf.indirect.csv");
  for (const Candidate& candidate : candidates) {
    LightBakeOptions options;
    options.method = candidate.kind;
    options.estimator.photons = candidate.photons;
    Progress silent;
    LightBakeStatistics statistics;
    const std::clock_t start = std::clock();
    auto grids = bake_light(**world, options, silent, statistics);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (!grids) return std::fprintf(stderr, "%s\n", grids.error().message().c_str()), false;
    const LightField field(layers_of(std::move(*grids)));
    const bool by_photons = !candidate.kind->node_by_node;
    std::printf("| %s | %s | %s | %.1f | %.1f | %.1f |\n", room, candidate.kind->name,
                by_photons ? (std::to_string(candidate.photons / 1000000) + " M").c_str() : "-", seconds,
                error_of(field, free), error_of(field, surfaces));
    std::fflush(stdout);
  }
  return true;
}

}  // namespace
}  // namespace lightwell

int main(int count, char** arguments) {
  using namespace lightwell;
  if (count != 2) return std::fprintf(stderr, "usage: bake_bench FOLDER\n"), 1;
  const EstimatorKind printed{"faces, as printed", "", false, make_printed_face_estimator};
  std::vector<Candidate> candidates;
  for (const EstimatorKind& kind : estimators())
    for (const uint64_t photons : {1'000'000, 8'000'000})
      if (photons > 1'000'000 || !kind.node_by_node) candidates.push_back({&kind, photons});
  candidates.push_back({&printed, 1'000'000});
  std::printf(
      "| room | estimator | photons | processor seconds, all | error in free space %% | on surfaces %% |\n"
      "|---|---|---|---|---|---|\n");
  for (const char* room : {"a_cornell", "b_tworooms", "d_blob"})
    if (!compare(arguments[1], room, candidates)) return 1;
  return 0;
}
