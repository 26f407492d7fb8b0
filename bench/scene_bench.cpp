// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <filesystem>

#include "lightwell/scene/scene.h"

namespace lightwell {
namespace {

/// Measures loading a file or a built-in scene; skipped when there is no such file.
void load(benchmark::State& state, const std::string& path, bool is_file) {
  if (is_file && !std::filesystem::exists(path)) {
    state.SkipWithError((path + " is not there").c_str());
    return;
  }
  size_t triangles = 0;
  for (auto _ : state) {
    Report report;
    const auto scene = load_scene(path, {}, report);
    if (!scene) {
      state.SkipWithError(scene.error().message().c_str());
      return;
    }
    for (const Primitive& primitive : scene->primitives) triangles += primitive.mesh.faces.size();
  }
  state.counters["triangles/s"] = benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsRate);
}

const std::string scans = "../shared/data/scans/";

BENCHMARK_CAPTURE(load, box, "box", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, box_small, "box-small", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, dragon_ply, scans + "dragon-871k.ply.gz", true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, armadillo_obj, scans + "armadillo.obj.gz", true)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lightwell

BENCHMARK_MAIN();
