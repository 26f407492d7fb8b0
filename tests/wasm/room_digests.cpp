// SPDX-License-Identifier: Apache-2.0
//
// room_digests: reads the cases of room_inputs from the standard input, gives each to its room and prints a CRC-32C of
// all that comes of it, state by state. Built natively and as WebAssembly, it has to print the same.
#include <cstdio>
#include <cstring>
#include <type_traits>

#include "lightwell/base/crc32c.h"
#include "lightwell/base/file_blocks.h"
#include "lightwell/base/half.h"
#include "lightwell/base/random.h"
#include "lightwell/base/range_coder.h"
#include "lightwell/base/transform.h"
#include "lightwell/light/atlas.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/light/stream.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/pack/block_table.h"
#include "lightwell/pack/opening.h"
#include "lightwell/pack/self_contained.h"
#include "lightwell/texture/stream.h"
#include "tests/asset/asset_case.h"
#include "tests/cases/case.h"

using namespace lightwell;

namespace {

/// The CRC-32C of all that was added.
class Digest {
 public:
  template <typename T>
  void add(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    crc_ = crc32c({reinterpret_cast<const uint8_t*>(values.data()), values.size_bytes()}, crc_);
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add(std::span<const T>(values));
  }
  template <typename T>
  void add(const T& value) {
    add(std::span<const T>(&value, 1));
  }
  void add(const Error& error) { add(std::span<const char>(error.message())); }
  uint32_t value() const { return crc_; }

 private:
  uint32_t crc_ = 0;
};

/// The bytes taken for the output of an encoder: bits, symbols and integers of every kind.
void decode(Bytes bytes, Digest& digest) {
  RangeDecoder decoder(bytes);
  AdaptiveBit bit;
  AdaptiveSymbol<8> symbol;
  AdaptiveInteger integer;
  AdaptiveNatural natural;
  while (!decoder.overrun()) {
    digest.add(decoder.bit(bit));
    digest.add(symbol.decode(decoder));
    digest.add(integer.decode(decoder));
    digest.add(natural.decode(decoder));
    digest.add(decoder.raw(1 + static_cast<int>(symbol.decode(decoder) % 32)));
  }
}

/// The bytes taken for what an encoder is to write.
void encode(Bytes bytes, Digest& digest) {
  RangeEncoder encoder;
  AdaptiveBit bit;
  AdaptiveSymbol<8> symbol;
  AdaptiveInteger integer;
  for (ByteReader reader(bytes); reader.remaining() > 0;) {
    encoder.bit(bit, reader.u8() < 200);
    symbol.encode(encoder, reader.u8());
    integer.encode(encoder, static_cast<int32_t>(reader.u32()) >> (reader.u8() & 31));
  }
  digest.add(encoder.finish());
}

/// Maps of a few random nodes, in doubles.
void transform(Random& random, Digest& digest) {
  const auto number = [&] { return 2 * static_cast<double>(random.uniform()) - 1; };
  Transform chain;
  for (int depth = 0; depth < 4; depth++) {
    const Vec<double, 4> turn{{number(), number(), number(), number()}};
    const Vec3d shift{{number(), number(), number()}}, size{{1.5 + number(), 2 + number(), -3 + number()}};
    chain = chain * Transform::translation(shift) * Transform::rotation(turn * (1 / length(turn))) *
            Transform::scaling(size);
    digest.add(chain);
    digest.add(chain.inverse());
    digest.add(chain.normal({{0.6f, 0, 0.8f}}));
  }
}

void base(const Case& one, Digest& digest) {
  const Bytes bytes = one.parts[0];
  decode(bytes, digest);
  encode(bytes, digest);
  Random random(bytes.size(), 0);
  transform(random, digest);
  for (ByteReader reader(bytes); reader.remaining() > 0;) digest.add(from_half(to_half(reader.f32())));
}

void look_up(const LightGrid& grid, Digest& digest) {
  Random random(grid.shape.count(), 0);
  const auto number = [&] { return 3 * random.uniform() - 1; };
  for (int i = 0; i < 50; i++) {
    const Vec3f place = grid.shape.lo + (grid.shape.hi() - grid.shape.lo) * Vec3f{{number(), number(), number()}};
    digest.add(grid.irradiance(place, normalized(Vec3f{{number(), number(), 1}})));
  }
}

void fill_and_look_up(const LightDecoder& decoder, Digest& digest) {
  for (const Fill fill : {Fill::none, Fill::push_pull, Fill::push_pull_smooth}) {
    LightGrid grid = decoder.grid();
    push_pull(grid, decoder.known(), fill);
    digest.add(grid.moments);
    digest.add(grid.valid);
    look_up(grid, digest);
    LightAtlas atlas(grid.shape, grid.normal_offset, decoder.layout().scale);
    atlas.update(grid);
    digest.add(atlas.halves());
    fill_invalid(grid);
    digest.add(grid.moments);
    digest.add(light_scale(grid));
  }
}

void light(const Case& one, Digest& digest) {
  uint64_t stream_bytes = 0;
  for (size_t i = 1; i < one.parts.size(); i++) stream_bytes += one.parts[i].size();
  auto decoder = LightDecoder::open(one.parts[0], stream_bytes);
  if (!decoder) return digest.add(decoder.error());
  fill_and_look_up(*decoder, digest);
  for (size_t i = 1; i < one.parts.size(); i++) {
    const auto appended = decoder->append(one.parts[i]);
    if (!appended) digest.add(appended.error());
    digest.add(decoder->known());
    digest.add(decoder->grid().moments);
  }
  fill_and_look_up(*decoder, digest);
}

void add_mesh(MeshDecoder& decoder, Digest& digest) {
  digest.add(decoder.vertices());
  digest.add(decoder.faces());
  digest.add(decoder.positions());
  digest.add(decoder.normals());
  for (const int set : {0, 1}) digest.add(decoder.texcoords(set));
  digest.add(decoder.colors());
  digest.add(decoder.index_buffer());
  const MeshChanges changes = decoder.take_changes();
  digest.add(changes.vertices);
  digest.add(changes.indices);
  digest.add(changes.rewired);
}

/// The buffers as a mesh of its own, shaded smoothly.
void shade(const MeshDecoder& decoder, Digest& digest) {
  Mesh mesh;
  mesh.positions.assign(decoder.positions().begin(), decoder.positions().end());
  for (size_t region = 0; region < decoder.layout().region_count(); region++) {
    const auto corners = decoder.indices(region);
    for (size_t i = 0; i < corners.size(); i += 3) mesh.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  digest.add(smooth_normals(mesh));
}

void mesh(const Case& one, Digest& digest) {
  const auto parameters = MeshParameters::read(one.parts[0], one.parts[0].size() > 53);
  if (!parameters) return digest.add(parameters.error());
  const auto base = BaseArrays::read(parameters->layout, parameters->places, one.parts[1]);
  if (!base) return digest.add(base.error());
  uint64_t stream_bytes = 0;
  for (size_t i = 2; i < one.parts.size(); i++) stream_bytes += one.parts[i].size();
  auto decoder = MeshDecoder::open(parameters->layout, base->view(), stream_bytes);
  if (!decoder) return digest.add(decoder.error());
  add_mesh(*decoder, digest);
  for (size_t i = 2; i < one.parts.size(); i++) {
    const auto appended = decoder->append(one.parts[i]);
    if (!appended) digest.add(appended.error());
    add_mesh(*decoder, digest);
  }
  shade(*decoder, digest);
}

void texture(const Case& one, Digest& digest) {
  const auto parameters = decode_texture_parameters(one.parts[0]);
  if (!parameters) return digest.add(parameters.error());
  FileBlocks decoder(parameters->bytes);
  for (size_t i = 1; i < one.parts.size(); i++) {
    const auto appended = decoder.append(one.parts[i]);
    if (!appended) digest.add(appended.error());
    digest.add(decoder.complete());
  }
  digest.add(decoder.file());
}

/// All extents of a stream, page after page.
void read_stream(const StreamEntry& entry, const PackId& id, Bytes file, uint64_t data_begin, Digest& digest) {
  auto table = BlockTable::place(entry, data_begin);
  if (!table) return;
  digest.add(std::span<const uint8_t>(entry.parameters));
  for (uint32_t i = 0; i < table->known(); i++) {
    const Extent extent = table->extent(i);
    const Bytes payload = checked_payload(file.subspan(size_t(extent.begin), extent.length), id);
    digest.add(payload);
    if (!extent.page) continue;
    const auto added = table->add_page(payload);
    if (!added) return digest.add(added.error());
  }
  digest.add(std::span<const BlockRow>(table->rows()));
}

void pack(const Case& one, Digest& digest) {
  const Bytes file = one.parts[0];
  const auto size = measure_opening(file);
  if (!size) return digest.add(size.error());
  digest.add(size->opening_length);
  digest.add(size->needed);
  if (!size->complete || size->needed > file.size()) return;
  const auto opening_length = size_t(size->opening_length);
  const std::vector<uint8_t> glb = opening_as_glb(file.first(opening_length));
  digest.add(glb);
  const Bytes json = glb_chunks(glb).json;
  if (const auto checked = check_self_contained({reinterpret_cast<const char*>(json.data()), json.size()}); !checked)
    digest.add(checked.error());
  const auto directory =
      Directory::read(file.subspan(opening_length, size_t(size->needed) - opening_length), file.size());
  if (!directory) return digest.add(directory.error());
  for (const StreamEntry& entry : directory->streams) read_stream(entry, directory->id, file, opening_length, digest);
}

void add_update(const Update& update, Digest& digest) {
  digest.add(static_cast<uint32_t>(update.index()));
  if (const auto* mesh = std::get_if<MeshUpdate>(&update)) {
    digest.add(mesh->asset);
    digest.add(mesh->vertices);
    digest.add(mesh->faces);
    digest.add(mesh->attributes);
  } else if (const auto* range = std::get_if<RangeUpdate>(&update)) {
    digest.add(range->buffer);
    digest.add(range->offset);
    digest.add(range->data);
  } else if (const auto* draw = std::get_if<DrawUpdate>(&update)) {
    digest.add(draw->vertices);
    digest.add(draw->faces);
  } else if (const auto* light = std::get_if<LightUpdate>(&update)) {
    digest.add(light->nodes);
    digest.add(light->atlas);
  } else if (const auto* image = std::get_if<TextureUpdate>(&update)) {
    digest.add(image->format);
    digest.add(image->file);
  } else if (const auto* parts = std::get_if<PartsUpdate>(&update)) {
    digest.add(parts->inflated);
    digest.add(parts->file);
  }
}

/// A stream by the table of codecs, and its updates after every block.
void asset(const Case& one, Digest& digest) {
  AssetContext context{.bin = one.parts[2], .fill = Fill::push_pull};
  auto opened = open_asset(directory_of(one), 0, context);
  digest.add(static_cast<uint32_t>(context.budget));
  if (!opened) return digest.add(opened.error());
  AssetDecoder& decoder = **opened;
  if (const auto update = decoder.announce()) add_update(*update, digest);
  for (size_t i = 3; i < one.parts.size(); i++) {
    if (const auto appended = decoder.append(one.parts[i]); !appended) digest.add(appended.error());
    digest.add(static_cast<uint32_t>(decoder.added()));
    digest.add(decoder.complete());
    decoder.settle();
    while (const auto update = decoder.take(1000)) add_update(*update, digest);
  }
}

std::vector<uint8_t> standard_input() {
  std::vector<uint8_t> all, piece(65536);
  while (const size_t length = std::fread(piece.data(), 1, piece.size(), stdin))
    all.insert(all.end(), piece.begin(), piece.begin() + static_cast<ptrdiff_t>(length));
  return all;
}

}  // namespace

int main() {
  struct NamedRoom {
    const char* name;
    void (*work)(const Case&, Digest&);
  };
  constexpr NamedRoom rooms[] = {{"base", base},       {"light", light}, {"mesh", mesh},
                                 {"texture", texture}, {"pack", pack},   {"asset", asset}};
  const std::vector<uint8_t> input = standard_input();
  for (ByteReader reader(input); reader.remaining() > 0;) {
    const Case one = read_case(reader);
    const NamedRoom& room = rooms[static_cast<size_t>(one.room)];
    Digest digest;
    room.work(one, digest);
    std::printf("%s %08x\n", room.name, digest.value());
  }
  return 0;
}
