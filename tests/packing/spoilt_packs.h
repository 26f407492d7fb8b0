// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/packing/opened_pack.h"
#include "tests/packing/nasty_json.h"
#include "tests/packing/sample_scenes.h"

namespace lightwell {

/// A small pack that has everything: a mesh, an image and a sky that are streamed, a lamp, a punctual light, a camera.
inline Packed pack_of_everything() {
  Document document = sheet_document(50);
  add_noise(document, 32);
  document.json["extensionsUsed"] = {"KHR_lights_punctual"};
  document.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", Json::object()}}};
  document.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
  document.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 2}}});
  document.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  document.json["scenes"][0]["nodes"] = {0, 1, 2};
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::rectangle;
  lamp.luminaire = {LuminaireId::Kind::surface, 0, 0, 0, 0};
  return pack(std::move(document), {lamp}, some_sky(128, 64));
}

/// Changes one stream of the directory: its parameters, what a row says, its error or its kind.
inline void spoil(std::vector<PackStream>& streams, Random& random) {
  PackStream& stream = streams[random.below(static_cast<uint32_t>(streams.size()))];
  switch (random.below(4)) {
    case 0:
      stream.parameters[random.below(static_cast<uint32_t>(stream.parameters.size()))] ^= 1u << random.below(8);
      break;
    case 1: stream.parameters.resize(random.below(static_cast<uint32_t>(stream.parameters.size() + 8))); break;
    case 2: stream.blocks[random.below(static_cast<uint32_t>(stream.blocks.size()))].adds += random.below(3); break;
    case 3: stream.kind = static_cast<StreamKind>(random.below(stream_kinds)); break;
  }
}

/// Changes bytes: one of its bits, a few of its bytes, or its length.
inline void spoil(std::vector<uint8_t>& bytes, Random& random) {
  if (bytes.empty()) return;
  const size_t at = random.below(static_cast<uint32_t>(bytes.size()));
  switch (random.below(3)) {
    case 0: bytes[at] = static_cast<uint8_t>(bytes[at] ^ 1u << random.below(8)); break;
    case 1:
      for (size_t i = at; i < std::min(bytes.size(), at + 4); i++) bytes[i] = static_cast<uint8_t>(random.bits());
      break;
    case 2: bytes.resize(at); break;
  }
}

/// Changes the payload of one block, such as an encoded mesh.
inline void spoil_a_block(std::vector<PackStream>& streams, Random& random) {
  PackStream& stream = streams[random.below(static_cast<uint32_t>(streams.size()))];
  spoil(stream.blocks[random.below(static_cast<uint32_t>(stream.blocks.size()))].payload, random);
}

/// The file of a sound pack changed at one place or two, number `edit` of all, with every check and length put right
/// again: its JSON, the directory, the payload of a block or what glTF readers see, the BIN.
inline std::vector<uint8_t> spoilt_pack(const OpenedPack& sound, const std::vector<PackStream>& streams,
                                        uint64_t edit) {
  Random random(47, edit);
  Json json = sound.json();
  std::vector<PackStream> changed = streams;
  std::vector<uint8_t> bin(sound.bin().begin(), sound.bin().end());
  switch (edit % 6) {
    case 0: spoil(changed, random); break;
    case 1: spoil_a_block(changed, random); break;
    case 2: spoil(bin, random); break;
    default:
      for (uint32_t changes = 1 + random.below(2); changes > 0; changes--) spoil(json, random);
  }
  return rewrite(sound, std::move(json), std::move(bin), std::move(changed));
}

}  // namespace lightwell
