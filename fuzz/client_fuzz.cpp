// SPDX-License-Identifier: Apache-2.0
//
// Gives a client any answers, in any order: the input is a script of what the network does, including its bytes.
#include <algorithm>

#include "lightwell/client/client.h"

using namespace lightwell;

namespace {

constexpr size_t most_steps = 2000;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  ByteReader script(Bytes(data, size));
  Client client({});
  double now = 0;
  uint32_t newest = 1;
  for (size_t step = 0; step < most_steps && script.remaining() > 0; step++) {
    if (const auto action = client.next(now); action && action->kind == Action::Kind::ask) newest = action->id;
    const uint8_t choice = script.u8();
    const uint32_t id = newest - std::min<uint32_t>(choice >> 4, newest);
    const Bytes bytes = script.take(std::min<size_t>(script.remaining(), script.u16()));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    switch (choice & 15) {
      case 0: client.respond(id, {206, "", ""}, now); break;
      case 1: client.respond(id, {200, "", text}, now); break;
      case 2: client.respond(id, {206, text, ""}, now); break;
      case 3: client.respond(id, {503, "", ""}, now); break;
      case 4: client.respond(id, {416, text, ""}, now); break;
      case 5: client.finish(id, now); break;
      case 6: client.fail(id, now); break;
      case 7: now += 1; break;
      default: client.receive(id, bytes, now); break;
    }
    for (int slice = 0; slice < 4 && (client.work() || client.take(1000)); slice++) {
    }
  }
  return 0;
}
