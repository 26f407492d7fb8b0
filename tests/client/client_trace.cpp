// SPDX-License-Identifier: Apache-2.0
//
// client_trace PACK: runs the client as wasm_test.mjs does and prints each update, its bytes as a CRC-32C.
#include <cstdio>

#include "lightwell/base/crc32c.h"
#include "lightwell/base/file.h"
#include "lightwell/client/client.h"

namespace lightwell {
namespace {

constexpr size_t piece_bytes = 5000;
constexpr size_t budget = 65536;
constexpr double latency = 0.01;

/// Prints an update's words in the order of client/wasm.h.
struct Print {
  void operator()(const OpeningUpdate& u) { std::printf("1 %u\n", crc32c(u.glb)); }
  void operator()(const MeshUpdate& u) {
    std::printf("2 %u %u %u %zu\n", u.stream, u.vertices, u.faces, u.attributes.size());
  }
  void operator()(const RangeUpdate& u) {
    std::printf("3 %u %u %u %u\n", u.stream, u.buffer, u.offset, crc32c(u.data));
  }
  void operator()(const DrawUpdate& u) { std::printf("4 %u %u %u\n", u.stream, u.vertices, u.faces); }
  void operator()(const LightUpdate& u) {
    std::printf("5 %u %u %u %u %u %u\n", u.stream, u.width, u.height, u.depth, u.nodes, crc32c(u.atlas));
  }
  void operator()(const TextureUpdate& u) {
    std::printf("6 %u %u %u %u %u\n", u.stream, u.format, u.width, u.height, crc32c(u.file));
  }
  void operator()(const CompleteUpdate&) { std::printf("7\n"); }
  void operator()(const FailureUpdate& u) { std::printf("8 %d %s\n", static_cast<int>(u.reason), u.message.c_str()); }
};

void answer(Client& client, Bytes file, const Action& action, double& now) {
  now += latency;
  const size_t first = static_cast<size_t>(action.first),
               last = std::min(static_cast<size_t>(action.last), file.size() - 1);
  const std::string range =
      "bytes " + std::to_string(first) + "-" + std::to_string(last) + "/" + std::to_string(file.size());
  client.respond(action.id, {206, range, "\"tag\""}, now);
  for (size_t at = first; at <= last; at += piece_bytes)
    client.receive(action.id, file.subspan(at, std::min(piece_bytes, last + 1 - at)), now += latency);
  client.finish(action.id, now);
}

void trace(Bytes file) {
  Client client({});
  double now = 0;
  while (!client.ended()) {
    const std::optional<Action> action = client.next(now);
    if (action && action->kind == Action::Kind::ask) answer(client, file, *action, now);
    const bool worked = client.work();
    const std::optional<Update> update = client.take(budget);
    if (update) std::visit(Print{}, *update);
    if (!action && !worked && !update) break;
  }
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
  const auto file = argc == 2 ? lightwell::read_file(argv[1]) : lightwell::fail("client_trace", "needs a pack");
  if (!file) return 1;
  lightwell::trace(*file);
  return 0;
}
