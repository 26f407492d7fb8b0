#include <cstdio>

#include "lightwell/transport/fetch.h"

int main(int count, char** arguments) {
  using namespace lightwell;
  auto line = http_transport(count > 1 ? arguments[1] : "http://127.0.0.1:8080/packs/box.lw.glb");
  if (!line) return std::fprintf(stderr, "%s\n", line.error().message().c_str()), 1;
  Client client(ClientOptions{});
  auto outcome = fetch(client, **line, [](const Update& update) {
    if (auto* draw = std::get_if<DrawUpdate>(&update)) std::printf("%u triangles\n", draw->faces);
  });
  if (!outcome) return std::fprintf(stderr, "%s\n", outcome.error().message().c_str()), 1;
}
