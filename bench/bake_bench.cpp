// SPDX-License-Identifier: Apache-2.0
//
// bake_bench FOLDER: what the estimators err by for their processor time, in the rooms of a folder whose irradiance
// another renderer has measured: ROOM.glb, ROOM.free.indirect.csv and ROOM.surf.indirect.csv.
// bake_bench --nodes SCENE...: what regular grids for a target of 3 % err by at their nodes.
// bake_bench --tree SCENE...: how long Embree takes to build its tree, which no other figure here contains.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "lightwell/bake/light_bake.h"
#include "lightwell/bake/photon_estimator.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/light/stream.h"
#include "lightwell/render/probe.h"
#include "lightwell/scene/scene.h"
#include "lightwell/trace/sampling.h"

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

/// Nodes on the longest axis.
constexpr int nodes = 32;

/// The root mean square difference of the irradiance at the valid nodes of a grid for 48 directions, in percent of its
/// root mean square.
double difference(const LightGrid& whole, const LightGrid& other) {
  constexpr size_t directions = 48;
  double squares = 0, size = 0;
  for (size_t node = 0; node < whole.moments.size(); node++) {
    if (!whole.valid[node]) continue;
    for (size_t i = 0; i < directions; i++) {
      const Vec3f n = sphere_direction(i, directions, 0.5f, 0);
      const Vec3f light = whole.moments[node].irradiance(n), off = other.moments[node].irradiance(n) - light;
      squares += static_cast<double>(dot(off, off));
      size += static_cast<double>(dot(light, light));
    }
  }
  return 100 * std::sqrt(squares / size);
}

/// What a share of a grid's nodes shows, filled: in the lattice order, and in that of S08's slices with push-pull.
void print_prefixes(const char* room, const LightGrid& grid) {
  ByteWriter of_lattice, of_slices;
  const LatticeStream lattice = *encode_lattice(grid);
  const LightStream slices = *encode_light(grid);
  lattice.layout.write(of_lattice);
  slices.layout.write(of_slices);
  constexpr uint64_t enough = uint64_t(1) << 30;
  LatticeDecoder by_lattice = std::move(*LatticeDecoder::open(of_lattice.bytes(), enough));
  LightDecoder by_slices = std::move(*LightDecoder::open(of_slices.bytes(), enough));
  size_t lattice_bundle = 0, slices_bundle = 0;
  for (const double share : {0.01, 0.05, 0.25, 0.5}) {
    const auto wanted = static_cast<size_t>(share * static_cast<double>(grid.moments.size()));
    while (by_lattice.received() < wanted) (void)by_lattice.append(lattice.bundles[lattice_bundle++].payload);
    while (by_slices.received() < wanted) (void)by_slices.append(slices.bundles[slices_bundle++].payload);
    LightGrid filled = by_slices.grid();
    push_pull(filled, by_slices.known(), Fill::push_pull);
    std::printf("| %s | %.0f %% | %.1f | %.1f |\n", room, 100 * share,
                difference(grid, by_lattice.grid(Fill::push_pull)), difference(grid, filled));
  }
  std::fflush(stdout);
}

/// A scene and its world, which refers to it.
struct Room {
  std::unique_ptr<const Scene> scene;
  std::unique_ptr<const World> world;
};

/// Nothing, and said, when the file cannot be read.
std::optional<Room> load_room(const std::string& path) {
  Report report;
  auto scene = load_scene(path, {}, report);
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message().c_str()), std::nullopt;
  Room room{std::make_unique<const Scene>(std::move(*scene)), nullptr};
  auto world = World::build(*room.scene);
  if (!world) return std::fprintf(stderr, "%s\n", world.error().message().c_str()), std::nullopt;
  room.world = std::move(*world);
  return room;
}

/// What a regular grid for a target of 3 % errs by at its nodes themselves: at 400 valid ones that do not lie on the
/// grid's own faces, each in a direction of an axis, against the path tracer.
bool at_nodes(const std::string& path) {
  constexpr size_t tested = 400;
  const std::optional<Room> room = load_room(path);
  if (!room) return false;
  LightBakeOptions options;
  options.nodes = nodes;
  options.target_error = 0.03f;
  Progress silent;
  LightBakeStatistics statistics;
  const std::clock_t start = std::clock();
  const auto grids = bake_light(*room->world, options, silent, statistics);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (!grids) return std::fprintf(stderr, "%s\n", grids.error().message().c_str()), false;
  const LightGrid& grid = grids->front().grid;
  std::vector<ProbePoint> points;
  std::vector<Measured> found;
  for (Random random(1, 0); points.size() < tested;) {
    const size_t node = random.below(static_cast<uint32_t>(grid.moments.size()));
    Vec3f direction{};
    direction[static_cast<int>(points.size() % 3)] = points.size() % 2 == 0 ? 1.0f : -1.0f;
    const Vec3i at = grid.shape.node(node), from_end = grid.shape.cells() - at;
    if (!grid.valid[node] || at[0] * at[1] * at[2] * from_end[0] * from_end[1] * from_end[2] == 0) continue;
    points.push_back({grid.shape.position(at), direction});
    found.push_back({points.back().position, direction, grid.moments[node].irradiance(direction)});
  }
  const auto values = probe(*room->world, points, {.samples = 16384}, silent);
  if (!values) return false;
  double squares = 0, sum = 0;
  for (size_t i = 0; i < tested; i++) {
    const Vec3f off = found[i].irradiance - (*values)[i].irradiance;
    squares += static_cast<double>(dot(off, off));
    sum += static_cast<double>((*values)[i].irradiance[0] + (*values)[i].irradiance[1] + (*values)[i].irradiance[2]);
  }
  const double count = 3 * static_cast<double>(tested);
  std::printf("| %s | %zu | %.1f | %.1f |\n", path.substr(path.rfind('/') + 1).c_str(), grid.moments.size(), seconds,
              100 * std::sqrt(squares / count) / (sum / count));
  std::fflush(stdout);
  return true;
}

size_t bytes_of(const std::vector<LightBundle>& bundles) {
  size_t bytes = 0;
  for (const LightBundle& bundle : bundles) bytes += bundle.payload.size();
  return bytes;
}

/// What it costs to give regions of bricks streams of their own: bytes of a default bake's light.
bool regions(const std::string& path) {
  const std::optional<Room> loaded = load_room(path);
  if (!loaded) return false;
  Progress silent;
  LightBakeStatistics statistics;
  const auto grids = bake_light(*loaded->world, {}, silent, statistics);
  if (!grids) return std::fprintf(stderr, "%s\n", grids.error().message().c_str()), false;
  for (int halvings = 0; halvings <= BrickRegions::most_halvings; halvings++) {
    const LatticeStream stream = encode_lattice(grids->front().grid, {.halvings = halvings}).value();
    const size_t own = bytes_of(stream.bundles);
    size_t apart = 0, largest = 0;
    for (const std::vector<LightBundle>& region : stream.regions) {
      apart += bytes_of(region);
      largest = std::max(largest, bytes_of(region));
    }
    std::printf("| %s | %zu | %zu | %zu | %zu |\n", path.substr(path.rfind('/') + 1).c_str(), stream.regions.size(),
                own, largest, own + apart);
  }
  std::fflush(stdout);
  return true;
}

/// Embree's tree over a scene's faces, by the clock and by the processors' time.
bool build_tree(const std::string& path) {
  Report report;
  const auto scene = load_scene(path, {}, report);
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message().c_str()), false;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t busy = std::clock();
  const auto tree = TraceScene::build(*scene);
  const double processor = static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!tree) return std::fprintf(stderr, "%s\n", tree.error().message().c_str()), false;
  size_t faces = 0;
  for (const Instance& instance : scene->instances)
    faces += scene->primitives[static_cast<size_t>(instance.primitive)].mesh.faces.size();
  std::printf("| %s | %zu | %.2f | %.2f |\n", path.substr(path.rfind('/') + 1).c_str(), faces, seconds, processor);
  std::fflush(stdout);
  return true;
}

/// What is printed of each scene that is named.
struct OfScenes {
  const char* name;
  const char* head;
  bool (*print)(const std::string& path);
};
constexpr OfScenes parts_of_scenes[] = {
    {"--nodes", "| scene | nodes | processor seconds | error at the nodes % |\n|---|---|---|---|", at_nodes},
    {"--regions",
     "| scene | regions apart | bytes of the grid's own stream | of the largest region | of all "
     "|\n|---|---|---|---|---|",
     regions},
    {"--tree", "| scene | triangles | tree, seconds | processor seconds |\n|---|---|---|---|", build_tree}};

struct Candidate {
  const EstimatorKind* kind;
  uint64_t photons;
};

bool prefixes(const std::string& folder, const char* room) {
  const std::optional<Room> loaded = load_room(folder + '/' + room + ".glb");
  if (!loaded) return false;
  LightBakeOptions options;
  options.nodes = nodes;
  Progress silent;
  LightBakeStatistics statistics;
  const auto grids = bake_light(*loaded->world, options, silent, statistics);
  if (!grids) return std::fprintf(stderr, "%s\n", grids.error().message().c_str()), false;
  print_prefixes(room, grids->front().grid);
  return true;
}

bool compare(const std::string& folder, const char* room, const std::vector<Candidate>& candidates) {
  const std::optional<Room> loaded = load_room(folder + '/' + room + ".glb");
  if (!loaded) return false;
  const auto free = read_points(folder + '/' + room + ".free.indirect.csv");
  const auto surfaces = read_points(folder + '/' + room + ".surf.indirect.csv");
  for (const Candidate& candidate : candidates) {
    LightBakeOptions options;
    options.nodes = nodes;
    options.method = candidate.kind;
    options.estimator.photons = candidate.photons;
    Progress silent;
    LightBakeStatistics statistics;
    const std::clock_t start = std::clock();
    auto grids = bake_light(*loaded->world, options, silent, statistics);
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
  if (count < 2)
    return std::fprintf(stderr,
                        "usage: bake_bench [--prefixes] FOLDER, or bake_bench --nodes|--regions|--tree SCENE...\n"),
           1;
  for (const OfScenes& part : parts_of_scenes) {
    if (std::string(arguments[1]) != part.name) continue;
    std::printf("%s\n", part.head);
    for (int i = 2; i < count; i++)
      if (!part.print(arguments[i])) return 1;
    return 0;
  }
  const EstimatorKind printed{"faces, as printed", "", false, make_printed_face_estimator};
  std::vector<Candidate> candidates;
  for (const EstimatorKind& kind : estimators())
    for (const uint64_t photons : {1'000'000, 8'000'000})
      if (photons > 1'000'000 || !kind.node_by_node) candidates.push_back({&kind, photons});
  candidates.push_back({&printed, 1'000'000});
  if (count == 3 && std::string(arguments[1]) == "--prefixes") {
    std::printf("| room | nodes | lattice, error of the filled grid %% | slices %% |\n|---|---|---|---|\n");
    for (const char* room : {"a_cornell", "b_tworooms", "d_blob"})
      if (!prefixes(arguments[2], room)) return 1;
    return 0;
  }
  std::printf(
      "| room | estimator | photons | processor seconds, all | error in free space %% | on surfaces %% |\n"
      "|---|---|---|---|---|---|\n");
  for (const char* room : {"a_cornell", "b_tworooms", "d_blob"})
    if (!compare(arguments[1], room, candidates)) return 1;
  return 0;
}
