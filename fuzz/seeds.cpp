// SPDX-License-Identifier: Apache-2.0
//
// fuzz_seeds FOLDER: writes the inputs from which fuzzing starts, one folder for each target: generated streams, packs,
// meshes and images, and the rooms of tests/data.
#include <webp/encode.h>

#include <array>
#include <cstdio>
#include <filesystem>

#include "lightwell/base/file.h"
#include "lightwell/scene/write_ply.h"
#include "lightwell/texture/image_file.h"
#include "tests/cases/generate.h"
#include "tests/client/sample_pack.h"
#include "tests/mesh/shapes.h"

using namespace lightwell;
using namespace std::string_view_literals;
namespace fs = std::filesystem;

namespace {

// The fuzzer truncates longer inputs.
constexpr size_t longest_seed = 65536;

constexpr std::string_view ply_text =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty float z\nproperty uchar "
    "red\n"
    "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 9 9 9\n4 0 1 2 3\n";

constexpr std::string_view textured_ply_text =
    "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property double z\nelement face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
    "property int texnumber\nend_header\n0 0 9e6\n1 0 9e6\n0 1 9e6\n3 0 1 2 6 0 0 1 0 1 1 0\n";

constexpr std::string_view obj_text =
    "mtllib none.mtl\no square\nv 0 0 0\nv 1 0 0 0.5 0.5 1\nv 1 1 \\\n0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nusemtl a "
    "b\n"
    "f 1/1/1 2/2/1 3/1/1 4/2/1\nf -1//1 -2//1 -3//1\nl 1 2\n";

constexpr std::string_view stl_text =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

/// Eight pixels in the newer run-length coding: the rows of each channel one after another.
constexpr std::string_view radiance_text =
    "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 1 +X 8\n\x02\x02\x00\x08\x88\x10\x88\x20\x88\x30\x88\x80"sv;

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}

  void plant(const std::string& target, Bytes seed) {
    if (seed.size() > longest_seed) return;
    fs::create_directories(folder_ / target);
    const fs::path file = folder_ / target / std::to_string(planted_++);
    if (write_file(file.string(), seed)) return;
    std::fprintf(stderr, "fuzz_seeds: cannot write %s\n", file.c_str());
    std::exit(1);
  }

 private:
  fs::path folder_;
  int planted_ = 0;
};

void plant_streams(Seeds& seeds) {
  for (const Case& one : generate_cases()) {
    ByteWriter writer;
    write_case(writer, one);
    if (one.room == Room::light) seeds.plant("light", writer.bytes());
    if (one.room == Room::mesh) seeds.plant("mesh", writer.bytes());
    if (one.room == Room::asset) seeds.plant("asset", writer.bytes());
  }
}

/// A script for client_fuzz.cpp: the server sends a whole pack, and the client has time to decode it.
std::vector<uint8_t> client_script(Bytes pack) {
  constexpr uint8_t respond = 0, wait = 7, receive = 8;
  ByteWriter script;
  script.u8(respond);
  script.u16(0);
  script.u8(receive);
  script.u16(static_cast<uint16_t>(pack.size()));
  script.append(pack);
  for (int second = 0; second < 200; second++) {
    script.u8(wait);
    script.u16(0);
  }
  return script.release();
}

void plant_packs(Seeds& seeds) {
  const std::vector<uint8_t> pack = sample_pack(sample_scene(200, 6));
  const Bytes sent = Bytes(pack).first(std::min(pack.size(), longest_seed - 1000));
  seeds.plant("pack", pack);
  seeds.plant("client", client_script(sent));
  seeds.plant("gltf", pack);
}

void plant_scenes(Seeds& seeds) {
  for (const auto& entry : fs::directory_iterator(fs::path(LIGHTWELL_TEST_DATA) / "truth"))
    if (entry.path().extension() == ".glb") seeds.plant("gltf", read_file(entry.path().string()).value());
  seeds.plant("scene", write_ply(seamed_sphere(6, 8)));
  seeds.plant("scene", as_bytes(ply_text));
  seeds.plant("scene", as_bytes(textured_ply_text));
  seeds.plant("scene", as_bytes(obj_text));
  seeds.plant("scene", as_bytes(stl_text));
}

/// Scripts for import_fuzz.cpp: one that changes nothing, and random ones.
void plant_edits(Seeds& seeds) {
  constexpr uint8_t shorten = 7;  // the document itself, which is no array
  seeds.plant("import", std::array<uint8_t, 5>{0, 0, 0, 0, shorten});
  Random random(2, 0);
  for (int i = 1; i <= 8; i++) {
    ByteWriter script;
    for (int byte = 0; byte < 10 * i; byte++) script.u8(static_cast<uint8_t>(random.below(256)));
    seeds.plant("import", script.bytes());
  }
}

std::vector<uint8_t> webp(const Image& image) {
  uint8_t* bytes = nullptr;
  const size_t length = WebPEncodeRGBA(image.pixels.data(), image.width, image.height, 4 * image.width, 50, &bytes);
  std::vector<uint8_t> file(bytes, bytes + length);
  WebPFree(bytes);
  return file;
}

/// A picture of one pixel in a colour of a palette, and one of a run of two.
constexpr std::array<uint8_t, 66> small_bmp = {'B', 'M', 66, 0, 0, 0, 0, 0, 0, 0, 62, 0, 0, 0, 40,
                                               0,   0,   0,  1, 0, 0, 0, 1, 0, 0, 0,  1, 0, 8, 0};
constexpr std::array<uint8_t, 22> small_tga = {0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 24, 0, 0x81, 3, 2, 1};

void plant_images(Seeds& seeds) {
  Random random(1, 0);
  for (const int channels : {1, 3, 4}) {
    Image image{16, 12, channels, {}};
    for (int i = 0; i < 16 * 12 * channels; i++) image.pixels.push_back(static_cast<uint8_t>(random.below(256)));
    seeds.plant("texture", write_png(image));
    if (channels < 4) seeds.plant("texture", write_jpeg(image, 80));
    if (channels == 4) seeds.plant("texture", webp(image));
  }
  for (const auto& entry : fs::directory_iterator(fs::path(LIGHTWELL_TEST_DATA) / "ktx2"))
    if (entry.path().extension() == ".ktx2") seeds.plant("texture", read_file(entry.path().string()).value());
  seeds.plant("texture", as_bytes(radiance_text));
  seeds.plant("texture", small_bmp);
  seeds.plant("texture", small_tga);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  Seeds seeds(argv[1]);
  plant_streams(seeds);
  plant_packs(seeds);
  plant_scenes(seeds);
  plant_edits(seeds);
  plant_images(seeds);
  return 0;
}
