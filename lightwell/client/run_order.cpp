// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/run_order.h"

#include <algorithm>

namespace lightwell {

/// Extends a stream's marks to all extents known by now and advances to its first missing one.
RunOrder::Stream& RunOrder::follow(size_t stream) {
  streams_.resize(download_.directory().streams.size());
  Stream& order = streams_[stream];
  const uint32_t known = download_.table(stream).known();
  order.asked.resize(known);
  while (order.first_missing < known && !is_missing(stream, order.first_missing)) order.first_missing++;
  return order;
}

bool RunOrder::is_missing(size_t stream, uint32_t extent) const {
  return !streams_[stream].asked[extent] && !download_.here(stream, extent);
}

std::optional<Run> RunOrder::missing(size_t stream, uint64_t length, uint64_t ahead) {
  uint32_t first = follow(stream).first_missing;
  const BlockTable& table = download_.table(stream);
  const uint32_t known = table.known();
  if (first == known) return std::nullopt;
  const uint32_t last = known - 1;
  const bool page_missing = known < table.extents() && is_missing(stream, last);
  if (page_missing && table.extent(last).begin - table.extent(first).begin < ahead) first = last;
  const uint64_t begin = table.extent(first).begin;
  uint32_t end = first;
  do end++;
  while (end < known && is_missing(stream, end) && table.extent(end).end() - begin <= length);
  return Run{stream, first, end - first, begin, table.extent(end - 1).end()};
}

void RunOrder::asked(const Run& run) {
  Stream& order = follow(run.stream);
  std::fill_n(order.asked.begin() + run.first, run.count, uint8_t(1));
}

void RunOrder::unasked(const Run& run) {
  Stream& order = follow(run.stream);
  std::fill_n(order.asked.begin() + run.first, run.count, uint8_t(0));
  order.first_missing = std::min(order.first_missing, run.first);
}

}  // namespace lightwell
