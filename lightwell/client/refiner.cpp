// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/refiner.h"

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

Result<std::unique_ptr<Refiner>> make(const StreamEntry& entry, uint32_t stream, Bytes bin, Fill fill,
                                      uint64_t& budget) {
  if (entry.codec != 0)
    return fail(ErrorKind::unsupported, "codec",
                "the " + std::string(to_text(entry.kind)) + " codec " + std::to_string(entry.codec) +
                    " is not known to this program");
  switch (entry.kind) {
    case StreamKind::light: return make_light_refiner(entry, stream, fill, budget);
    case StreamKind::mesh: return make_mesh_refiner(entry, stream, bin, budget);
    case StreamKind::texture: return make_texture_refiner(entry, stream, budget);
  }
  LW_ASSERT(false);
}

}  // namespace

Result<std::unique_ptr<Refiner>> make_refiner(const Directory& directory, uint32_t stream, Bytes bin, Fill fill,
                                              uint64_t& budget) {
  auto refiner = make(directory.streams[stream], stream, bin, fill, budget);
  if (!refiner) return lightwell::fail(in_element(std::move(refiner.error()), "stream " + std::to_string(stream)));
  return refiner;
}

Result<void> spend(uint64_t& budget, uint64_t bytes) {
  if (bytes > budget)
    return fail(ErrorKind::limit, "", "the streams' buffers together would need more memory than a client gives them");
  budget -= bytes;
  return {};
}

}  // namespace lightwell
