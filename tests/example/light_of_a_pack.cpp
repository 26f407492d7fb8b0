#include <cstdio>

#include "lightwell/packing/unpack.h"

int main(int count, char** arguments) {
  using namespace lightwell;
  auto pack = OpenedPack::open_file(count > 1 ? arguments[1] : "box.lw.glb");
  if (!pack) return std::fprintf(stderr, "%s\n", pack.error().message().c_str()), 1;
  auto grid = unpack_light(pack->reader(), pack->grids().front().stream, LightLevel{});
  if (!grid) return std::fprintf(stderr, "%s\n", grid.error().message().c_str()), 1;
  const Vec3f middle = (grid->shape.lo + grid->shape.hi()) * 0.5f, up{{0, 1, 0}};
  const Vec3f light = grid->irradiance(middle, up);
  std::printf("%g %g %g W/m2\n", light[0], light[1], light[2]);
}
