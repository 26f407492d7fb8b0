// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/model_coder.h"
#include "lightwell/light/stream.h"
#include "lightwell/light/stream_head.h"

namespace lightwell {
Result<LightLayout> LightLayout::read(Bytes parameters) {
  ByteReader reader(parameters);
  LightLayout layout;
  layout.shape = read_shape(reader);
  layout.nodes_per_slice = reader.u16();
  layout.normal_offset = reader.f32();
  layout.scale = reader.f32();
  layout.seed = reader.u64();
  for (MomentsRecord& corner : layout.corners) corner = MomentsRecord::read(reader);
  if (!reader.ok() || reader.remaining() != 0) return fail("light parameters", "wrong length");

  LW_CHECK(check_head(layout.shape, layout.normal_offset, layout.scale));
  if (layout.nodes_per_slice < 1 || layout.nodes_per_slice > 1024)
    return fail("light parameters", "nodes of a slice out of range");
  return layout;
}

LightDecoder::LightDecoder(const LightLayout& layout)
    : layout_(layout),
      order_(light_order(layout.shape, layout.seed, layout.nodes_per_slice)),
      records_(layout.shape),
      coder_(std::make_unique<RecordCoder>()) {
  grid_.shape = layout.shape;
  grid_.normal_offset = layout.normal_offset;
  grid_.moments.resize(layout.shape.count());
  grid_.valid.assign(layout.shape.count(), 1);
  const std::array<size_t, 8> corners = corner_nodes(layout.shape);
  for (size_t i = 0; i < 8; i++) {
    records_.set(corners[i], layout.corners[i]);
    publish(corners[i]);
  }
}

Result<LightDecoder> LightDecoder::open(Bytes parameters, uint64_t stream_bytes) {
  LW_TRY(layout, LightLayout::read(parameters));
  if ((layout.shape.count() - layout.corners.size()) / light_nodes_per_byte > stream_bytes)
    return fail("light parameters", "promise more nodes than the stream's bytes can hold");
  return LightDecoder(layout);
}

Result<void> LightDecoder::append(Bytes payload) {
  if (complete()) return fail("light bundle", "the grid is complete already");
  const size_t end = order_.ends[bundle_];
  auto coder = std::make_unique<RecordCoder>(*coder_);
  ModelReader reader(payload);
  for (size_t i = at_; i < end; i++) {
    MomentsRecord record;
    coder->code(reader, record, records_, order_.nodes[i]);
    records_.set(order_.nodes[i], record);
  }
  if (reader.overrun()) {
    for (size_t i = at_; i < end; i++) records_.forget(order_.nodes[i]);
    return fail("light bundle", "ends too early");
  }
  for (; at_ < end; at_++) publish(order_.nodes[at_]);
  coder_ = std::move(coder);
  bundle_++;
  return {};
}

// Writes the decoded record of a node to the grid. 1 / scale is exact, since the scale is a power of two.
void LightDecoder::publish(size_t node) {
  grid_.moments[node] = decode_record(records_[node]) * (1 / layout_.scale);
  grid_.valid[node] = records_[node].valid();
}

}  // namespace lightwell
