// SPDX-License-Identifier: Apache-2.0
//
// The room `mesh` compared with its peers, on scan-like knots of 100 thousand and of a million triangles:
// simplification with meshoptimizer, the stream with Draco. Times are processor time of one thread.
#include <benchmark/benchmark.h>
#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <map>

#include "lightwell/mesh/progressive.h"
#include "lightwell/mesh/stream.h"
#include "tests/mesh/knot.h"
#include "tests/mesh/level.h"

namespace lightwell {
namespace {

Progress silent;

// Argument: thousands of triangles.
const Mesh& knot_of(int64_t thousands) {
  static std::map<int64_t, Mesh> made;
  auto& mesh = made[thousands];
  if (mesh.faces.empty()) mesh = thousands == 100 ? knot(830, 60) : knot(2730, 200);
  return mesh;
}

const ProgressiveMesh& progressive_of(int64_t thousands) {
  static std::map<int64_t, ProgressiveMesh> made;
  auto& progressive = made[thousands];
  if (progressive.parent.empty()) progressive = build_progressive(knot_of(thousands), {}, silent).value();
  return progressive;
}

void count_rate(benchmark::State& state, const char* name, double each) {
  state.counters[name] = benchmark::Counter(each, benchmark::Counter::kIsIterationInvariantRate);
}

// The whole order, quantisation and set-up included.
void simplify(benchmark::State& state) {
  const Mesh& mesh = knot_of(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(build_progressive(mesh, {}, silent));
  count_rate(state, "collapses_per_second", static_cast<double>(mesh.positions.size()));
}
BENCHMARK(simplify)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

// Arguments: thousands of triangles, and percent of them to keep. One target, not an order.
void simplify_meshoptimizer(benchmark::State& state) {
  const Mesh& mesh = knot_of(state.range(0));
  std::vector<uint32_t> out(3 * mesh.faces.size());
  const size_t target = out.size() * static_cast<size_t>(state.range(1)) / 100;
  size_t left = 0;
  for (auto _ : state)
    left = meshopt_simplify(out.data(), mesh.faces[0].data(), out.size(), mesh.positions[0].e.data(),
                            mesh.positions.size(), sizeof(Vec3f), target, 1e9f);
  count_rate(state, "collapses_per_second", static_cast<double>(out.size() - left) / 6);  // two faces a collapse
}
BENCHMARK(simplify_meshoptimizer)->ArgsProduct({{100, 1000}, {50, 10, 1}})->Unit(benchmark::kMillisecond);

void encode_stream(benchmark::State& state) {
  const ProgressiveMesh& progressive = progressive_of(state.range(0));
  uint64_t bytes = 0;
  for (auto _ : state) bytes = stream_bytes(encode(progressive));
  const auto vertices = static_cast<double>(progressive.mesh.positions.size());
  state.counters["bits_a_vertex"] = 8 * static_cast<double>(bytes) / vertices;
  count_rate(state, "triangles_per_second", static_cast<double>(progressive.mesh.faces.size()));
}
BENCHMARK(encode_stream)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

void decode_stream(benchmark::State& state) {
  const EncodedMesh encoded = encode(progressive_of(state.range(0)));
  const OpenedBase base(encoded.base);
  for (auto _ : state) {
    auto decoder = MeshDecoder::open(encoded.layout, base.arrays(), stream_bytes(encoded)).value();
    for (const MeshBlock& block : encoded.blocks) benchmark::DoNotOptimize(decoder.append(block.payload));
  }
  count_rate(state, "triangles_per_second", encoded.layout.faces);
}
BENCHMARK(decode_stream)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

int add_draco_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, const std::vector<Vec3f>& values) {
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, 3, draco::DT_FLOAT32, false, sizeof(Vec3f), 0);
  const int id = mesh.AddAttribute(attribute, true, static_cast<uint32_t>(values.size()));
  for (uint32_t v = 0; v < values.size(); v++)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), values[v].e.data());
  return id;
}

// 14-bit positions and 10-bit normals, one shot. Arguments: thousands of triangles, and Draco's speed.
draco::EncoderBuffer draco_of(int64_t thousands, int64_t speed) {
  const Mesh& mesh = knot_of(thousands);
  draco::Mesh out;
  out.set_num_points(static_cast<uint32_t>(mesh.positions.size()));
  for (const Face& f : mesh.faces)
    out.AddFace({draco::PointIndex(f[0]), draco::PointIndex(f[1]), draco::PointIndex(f[2])});
  add_draco_attribute(out, draco::GeometryAttribute::POSITION, mesh.positions);
  add_draco_attribute(out, draco::GeometryAttribute::NORMAL, mesh.normals);
  draco::Encoder encoder;
  encoder.SetSpeedOptions(static_cast<int>(speed), static_cast<int>(speed));
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 10);
  draco::EncoderBuffer buffer;
  encoder.EncodeMeshToBuffer(out, &buffer);
  return buffer;
}

void decode_draco(benchmark::State& state) {
  const draco::EncoderBuffer encoded = draco_of(state.range(0), state.range(1));
  for (auto _ : state) {
    draco::DecoderBuffer buffer;
    buffer.Init(encoded.data(), encoded.size());
    draco::Decoder decoder;
    benchmark::DoNotOptimize(decoder.DecodeMeshFromBuffer(&buffer));
  }
  const Mesh& mesh = knot_of(state.range(0));
  state.counters["bits_a_vertex"] =
      8 * static_cast<double>(encoded.size()) / static_cast<double>(mesh.positions.size());
  count_rate(state, "triangles_per_second", static_cast<double>(mesh.faces.size()));
}
BENCHMARK(decode_draco)->ArgsProduct({{100, 1000}, {0, 3}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lightwell

BENCHMARK_MAIN();
