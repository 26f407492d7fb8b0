// SPDX-License-Identifier: Apache-2.0
//
// The costs of the light grid: push-pull with and without smoothing, decoding, the size of the stream, the atlas. Grids
// of 32^3 nodes in the light of eight small lamps, with noise like that of a bake.
#include <benchmark/benchmark.h>

#include "lightwell/light/atlas.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/light/stream.h"
#include "tests/light/light_fields.h"

namespace lightwell {
namespace {

LightGrid cube(int nodes, float noise) {
  return lamp_grid(GridShape::over({{{0, 0, 0}}, {{4, 4, 4}}}, nodes), 3, noise);
}

// Half of the nodes are known, as in Figure 2 of S08 (Pacanowski, Granier et al., "Efficient Streaming of 3D Scenes
// with Complex Geometry and Complex Lighting", Web3D 2008).
void push_pull_half(benchmark::State& state, Fill fill) {
  const LightGrid grid = cube(32, 0.03f);
  Random random(1, 0);
  std::vector<uint8_t> known(grid.valid.size());
  for (uint8_t& k : known) k = random.below(2) != 0;
  for (auto _ : state) {
    state.PauseTiming();
    LightGrid filled = grid;
    state.ResumeTiming();
    push_pull(filled, known, fill);
    benchmark::DoNotOptimize(filled.moments.data());
  }
}
BENCHMARK_CAPTURE(push_pull_half, plain, Fill::push_pull)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(push_pull_half, smooth, Fill::push_pull_smooth)->Unit(benchmark::kMillisecond);

/// Decodes and fills a grid. Argument: noise in percent.
template <typename Encode, typename Decoder>
void decode(benchmark::State& state, const Encode& encode, const Decoder& open) {
  const LightGrid grid = cube(32, 0.01f * static_cast<float>(state.range(0)));
  const auto stream = encode(grid).value();
  ByteWriter parameters;
  stream.layout.write(parameters);
  size_t bytes = parameters.size();
  for (const LightBundle& bundle : stream.bundles) bytes += bundle.payload.size();
  for (auto _ : state) {
    auto decoder = open(parameters.bytes(), bytes).value();
    for (const LightBundle& bundle : stream.bundles) benchmark::DoNotOptimize(decoder.append(bundle.payload));
  }
  const auto nodes = static_cast<double>(grid.moments.size());
  state.counters["bytes_a_node"] = static_cast<double>(bytes) / nodes;
  state.counters["seconds_a_node"] =
      benchmark::Counter(nodes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
void decode_slices(benchmark::State& state) {
  decode(
      state, [](const LightGrid& grid) { return encode_light(grid); }, LightDecoder::open);
}
void decode_lattice(benchmark::State& state) {
  decode(
      state, [](const LightGrid& grid) { return encode_lattice(grid); }, LatticeDecoder::open);
}
BENCHMARK(decode_slices)->Arg(0)->Arg(3)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK(decode_lattice)->Arg(0)->Arg(3)->Arg(10)->Unit(benchmark::kMillisecond);

/// The whole grid of a decoder, as it is filled for each picture of it.
void lattice_grid(benchmark::State& state) {
  const LatticeStream stream = encode_lattice(cube(32, 0.03f)).value();
  ByteWriter parameters;
  stream.layout.write(parameters);
  LatticeDecoder decoder = LatticeDecoder::open(parameters.bytes(), uint64_t(1) << 30).value();
  for (const LightBundle& bundle : stream.bundles) benchmark::DoNotOptimize(decoder.append(bundle.payload));
  for (auto _ : state) benchmark::DoNotOptimize(decoder.grid(Fill::push_pull).moments.data());
}
BENCHMARK(lattice_grid)->Unit(benchmark::kMillisecond);

void write_atlas(benchmark::State& state) {
  const LightGrid grid = cube(32, 0);
  LightAtlas atlas(grid.shape, grid.normal_offset, light_scale(grid));
  for (auto _ : state) {
    atlas.update(grid);
    benchmark::DoNotOptimize(atlas.halves().data());
  }
}
BENCHMARK(write_atlas)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lightwell

BENCHMARK_MAIN();
