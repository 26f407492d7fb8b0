// SPDX-License-Identifier: Apache-2.0
//
// client_trace PACK STRATEGY FILL FAULT: runs the client as wasm_test.mjs does and prints each update, its bytes as a
// CRC-32C. Strategy and fill are numbered as in client/wasm.h. Every fifth body: fault 1 breaks in the middle, 2 has a
// wrong bit there, 0 is as the others.
#include <cmath>
#include <cstdio>
#include <cstdlib>

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
    std::printf("2 %u %u %u %zu", u.asset, u.vertices, u.faces, u.attributes.size());
    for (const AttributeLayout& a : u.attributes)
      std::printf(" %d,%d,%d,%d,%d", static_cast<int>(a.semantic), static_cast<int>(a.component), a.components,
                  a.stride, a.normalized);
    std::printf("\n");
  }
  void operator()(const RangeUpdate& u) { std::printf("3 %u %u %u %u\n", u.asset, u.buffer, u.offset, crc32c(u.data)); }
  void operator()(const DrawUpdate& u) { std::printf("4 %u %u %u\n", u.asset, u.vertices, u.faces); }
  void operator()(const LightUpdate& u) {
    std::printf("5 %u %u %u %u %u %u\n", u.asset, u.width, u.height, u.depth, u.nodes, crc32c(u.atlas));
  }
  void operator()(const TextureUpdate& u) {
    std::printf("6 %u %u %u %u %u\n", u.asset, u.format, u.width, u.height, crc32c(u.file));
  }
  void operator()(const PartsUpdate& u) { std::printf("9 %u %u %u\n", u.asset, u.inflated, crc32c(u.file)); }
  void operator()(const CompleteUpdate&) { std::printf("7\n"); }
  void operator()(const FailureUpdate& u) { std::printf("8 %d %s\n", static_cast<int>(u.reason), u.message.c_str()); }
};

void answer(Client& client, Bytes file, const Action& action, int fault, double& now) {
  now += latency;
  const size_t first = static_cast<size_t>(action.first),
               last = std::min(static_cast<size_t>(action.last), file.size() - 1);
  const std::string range =
      "bytes " + std::to_string(first) + "-" + std::to_string(last) + "/" + std::to_string(file.size());
  client.respond(action.id, {206, range, "\"tag\""}, now);
  std::vector<uint8_t> body(file.begin() + static_cast<std::ptrdiff_t>(first),
                            file.begin() + static_cast<std::ptrdiff_t>(last + 1));
  const bool faulty = action.id % 5 == 0;
  if (faulty && fault == 1) body.resize(body.size() / 2);
  if (faulty && fault == 2) body[body.size() / 2] ^= 1;
  for (size_t at = 0; at < body.size(); at += piece_bytes)
    client.receive(action.id, Bytes(body).subspan(at, std::min(piece_bytes, body.size() - at)), now += latency);
  if (faulty && fault == 1)
    client.fail(action.id, now);
  else
    client.finish(action.id, now);
}

void trace(Bytes file, const ClientOptions& options, int fault) {
  Client client(options);
  double now = 0;
  while (!client.ended()) {
    const std::optional<Action> action = client.next(now);
    if (action && action->kind == Action::Kind::ask) answer(client, file, *action, fault, now);
    const bool worked = client.work();
    const std::optional<Update> update = client.take(budget);
    if (update) std::visit(Print{}, *update);
    if (action || worked || update) continue;
    if (!std::isfinite(client.wake())) break;
    now = std::max(now, client.wake());
  }
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
  using namespace lightwell;
  const auto file = argc == 5 ? read_file(argv[1]) : fail("client_trace", "needs a pack and three numbers");
  if (!file) return 1;
  ClientOptions options;
  options.strategy = static_cast<Strategy>(std::atoi(argv[2]));
  options.fill = static_cast<Fill>(std::atoi(argv[3]));
  trace(*file, options, std::atoi(argv[4]));
  return 0;
}
