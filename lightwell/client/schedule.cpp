// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/schedule.h"

#include <algorithm>
#include <tuple>

#include "lightwell/light/lattice_stream.h"

namespace lightwell {
namespace {

int rank(Strategy strategy, StreamKind kind) {
  switch (strategy) {
    case Strategy::geometry: return kind == StreamKind::mesh ? 0 : kind == StreamKind::texture ? 1 : 2;
    case Strategy::light: return is_light(kind) ? 0 : 1;
    case Strategy::interleave: return 0;
  }
  return 0;
}

/// The error that remains once all blocks before `block` have arrived.
float error_before(const Download& download, size_t stream, uint32_t block) {
  return block == 0 ? download.directory().streams[stream].error : download.table(stream).rows()[block - 1].error;
}

/// What an error of a stream is a share of: its first one, or of bricks that of their grid, whose light they mend.
float whole_error(const Directory& directory, const StreamEntry& entry) {
  if (entry.kind != StreamKind::bricks) return entry.error;
  const auto layout = BricksLayout::read(entry.parameters);
  return layout && layout->grid < directory.streams.size() ? directory.streams[layout->grid].error : entry.error;
}

/// The share of the stream's first error that a run removes per byte. A page removes nothing itself; it is worth the
/// average of everything after it.
double benefit(const Download& download, const Run& run) {
  const StreamEntry& entry = download.directory().streams[run.stream];
  const float whole = whole_error(download.directory(), entry);
  if (whole <= 0) return 0;
  const BlockTable& table = download.table(run.stream);
  const Extent first = table.extent(run.first);
  const float before = error_before(download, run.stream, first.block);
  if (first.page) return before / whole / static_cast<double>(table.end() - run.begin);
  const Extent last = table.extent(run.first + run.count - 1);
  const float after = error_before(download, run.stream, last.page ? last.block : last.block + 1);
  return std::max(0.0f, before - after) / whole / static_cast<double>(run.end - run.begin);
}

}  // namespace

std::optional<Run> choose(RunOrder& order, Strategy strategy, std::span<const float> weights, uint64_t length,
                          uint64_t in_flight) {
  const Download& download = order.download();
  const std::vector<StreamEntry>& streams = download.directory().streams;
  std::optional<Run> best;
  std::tuple<int, double, StreamKind> best_key;
  for (size_t i = 0; i < streams.size(); i++) {
    const std::optional<Run> run = order.missing(i, length, length * in_flight);
    if (!run) continue;
    const std::tuple key(rank(strategy, streams[i].kind), -weights[i] * benefit(download, *run), streams[i].kind);
    if (best && key >= best_key) continue;
    best = run;
    best_key = key;
  }
  return best;
}

}  // namespace lightwell
