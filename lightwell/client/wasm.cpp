// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/wasm.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "lightwell/client/client.h"

using namespace lightwell;

namespace {

constexpr uint32_t abi_version = 2;

std::vector<uint8_t> input;
std::array<uint32_t, 32> record;
std::string message;  ///< of the last failure taken

Client& client_of(uint32_t handle) { return *reinterpret_cast<Client*>(static_cast<uintptr_t>(handle)); }

uint32_t address(const void* pointer) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(pointer)); }

template <typename... Words>
uint32_t answer(uint32_t kind, Words... words) {
  record = {static_cast<uint32_t>(words)...};
  return kind;
}

std::string_view input_text(uint32_t begin, uint32_t length) {
  return {reinterpret_cast<const char*>(input.data()) + begin, length};
}

Strategy strategy_of(uint32_t number) {
  return static_cast<Strategy>(std::min(number, static_cast<uint32_t>(Strategy::light)));
}

uint32_t word_of(const AttributeLayout& layout) {
  return static_cast<uint32_t>(layout.semantic) | static_cast<uint32_t>(layout.component) << 8 |
         uint32_t(layout.components) << 16 | uint32_t(layout.stride) << 20 | uint32_t(layout.normalized) << 31;
}

/// Writes an update to the record and returns its kind; wasm.h describes the words.
struct WriteUpdate {
  uint32_t operator()(const OpeningUpdate& update) { return answer(1, address(update.glb.data()), update.glb.size()); }
  uint32_t operator()(const MeshUpdate& update) {
    answer(2, update.asset, update.vertices, update.faces, update.attributes.size());
    std::ranges::transform(update.attributes, record.begin() + 4, word_of);
    return 2;
  }
  uint32_t operator()(const RangeUpdate& update) {
    return answer(3, update.asset, update.buffer, update.offset, address(update.data.data()), update.data.size());
  }
  uint32_t operator()(const DrawUpdate& update) {
    return answer(4, update.asset, update.vertices, update.faces, address(update.regions.data()),
                  update.regions.size());
  }
  uint32_t operator()(const LightUpdate& update) {
    return answer(5, update.asset, update.width, update.height, update.depth, update.nodes,
                  address(update.atlas.data()), update.atlas.size());
  }
  uint32_t operator()(const TextureUpdate& update) {
    return answer(6, update.asset, update.format, update.width, update.height, address(update.file.data()),
                  update.file.size());
  }
  uint32_t operator()(const PartsUpdate& update) {
    return answer(9, update.asset, update.inflated, address(update.file.data()), update.file.size());
  }
  uint32_t operator()(const CompleteUpdate&) { return answer(7); }
  uint32_t operator()(const FailureUpdate& update) {
    message = update.message;
    return answer(8, static_cast<uint32_t>(update.reason), address(message.data()), message.size());
  }
};

}  // namespace

#define LW_EXPORT(name) __attribute__((export_name(#name))) name

extern "C" {

uint32_t LW_EXPORT(lw_abi_version)() { return abi_version; }

uint32_t LW_EXPORT(lw_create)(uint32_t strategy, uint32_t fill, uint32_t seed) {
  ClientOptions options;
  options.strategy = strategy_of(strategy);
  options.fill = static_cast<Fill>(std::min(fill, static_cast<uint32_t>(Fill::none)));
  options.seed = seed;
  return address(new Client(options));
}

void LW_EXPORT(lw_destroy)(uint32_t client) { delete &client_of(client); }

uint8_t* LW_EXPORT(lw_input)(uint32_t length) {
  if (input.size() < length) input.resize(length);
  return input.data();
}

const uint32_t* LW_EXPORT(lw_record)() { return record.data(); }

uint32_t LW_EXPORT(lw_next)(uint32_t client, double now) {
  const std::optional<Action> action = client_of(client).next(now);
  if (!action) return 0;
  if (action->kind == Action::Kind::cancel) return answer(2, action->id);
  return answer(1, action->id, action->first, action->last);
}

void LW_EXPORT(lw_respond)(uint32_t client, uint32_t request, uint32_t status, uint32_t content_range_length,
                           uint32_t etag_length, double now) {
  const ResponseHead head{static_cast<int>(status), input_text(0, content_range_length),
                          input_text(content_range_length, etag_length)};
  client_of(client).respond(request, head, now);
}

void LW_EXPORT(lw_receive)(uint32_t client, uint32_t request, uint32_t length, double now) {
  client_of(client).receive(request, Bytes(input).first(length), now);
}

void LW_EXPORT(lw_finish)(uint32_t client, uint32_t request, double now) { client_of(client).finish(request, now); }

void LW_EXPORT(lw_fail)(uint32_t client, uint32_t request, double now) { client_of(client).fail(request, now); }

double LW_EXPORT(lw_wake)(uint32_t client) { return client_of(client).wake(); }

uint32_t LW_EXPORT(lw_work)(uint32_t client) { return client_of(client).work(); }

uint32_t LW_EXPORT(lw_take)(uint32_t client, uint32_t budget) {
  const std::optional<Update> update = client_of(client).take(budget);
  return update ? std::visit(WriteUpdate{}, *update) : 0;
}

void LW_EXPORT(lw_set_strategy)(uint32_t client, uint32_t strategy) {
  client_of(client).set_strategy(strategy_of(strategy));
}

void LW_EXPORT(lw_set_weight)(uint32_t client, uint32_t asset, float weight) {
  client_of(client).set_weight(asset, weight);
}

void LW_EXPORT(lw_blocked_links)(uint32_t client, uint32_t asset) {
  static std::vector<Vec3f> ends;
  ends = client_of(client).blocked_links(asset);
  answer(0, address(ends.data()), 3 * ends.size());
}

void LW_EXPORT(lw_progress)(uint32_t client) {
  const ClientProgress p = client_of(client).progress();
  answer(0, p.bytes, p.bytes_total, p.geometry_bytes, p.geometry_bytes_total, p.light_bytes, p.light_bytes_total,
         p.faces, p.faces_total, p.nodes, p.nodes_total, p.requests, p.failures);
}
}
