// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/verify.h"

#include <functional>
#include <memory>

#include "lightwell/light/stream.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify_json.h"
#include "lightwell/packing/verify_scene.h"
#include "lightwell/texture/stream.h"

namespace lightwell {
namespace {

// A decoder of any kind: takes a payload and tells how many vertices, nodes or bytes it has so far.
struct StreamDecoder {
  std::function<Result<void>(Bytes)> append;
  std::function<uint64_t()> count;
  std::function<bool()> complete;
};

template <typename Decoder>
StreamDecoder wrap(Decoder decoder, uint64_t (*count)(const Decoder&)) {
  auto shared = std::make_shared<Decoder>(std::move(decoder));
  return {[shared](Bytes payload) { return shared->append(payload); }, [shared, count] { return count(*shared); },
          [shared] { return shared->complete(); }};
}

Result<StreamDecoder> open_stream(const PackReader& pack, const StreamEntry& entry) {
  switch (entry.kind) {
    case StreamKind::light: {
      LW_TRY(decoder, LightDecoder::open(entry.parameters, entry.length));
      return wrap<LightDecoder>(std::move(decoder), [](const LightDecoder& d) { return uint64_t(d.received()); });
    }
    case StreamKind::mesh: {
      LW_TRY(decoder, open_mesh_stream(pack, entry));
      return wrap<MeshDecoder>(std::move(decoder), [](const MeshDecoder& d) { return uint64_t(d.vertices()); });
    }
    case StreamKind::texture: {
      LW_TRY(parameters, decode_texture_parameters(entry.parameters));
      return wrap<TextureDecoder>(TextureDecoder(parameters),
                                  [](const TextureDecoder& d) { return uint64_t(d.file().size()); });
    }
  }
  return fail(ErrorKind::unsupported, "", "an unknown kind");
}

// Decodes a stream to its end and checks what each row promises.
Result<void> verify_stream(const PackReader& pack, size_t stream, uint64_t& blocks) {
  const StreamEntry& entry = pack.directory().streams[stream];
  LW_TRY(decoder, open_stream(pack, entry));
  for (uint32_t i = 0; i < entry.blocks; i++) {
    const std::string name = "block " + std::to_string(i);
    LW_TRY(payload, pack.block(stream, i));
    const uint64_t before = decoder.count();
    LW_CHECK(decoder.append(payload));
    const BlockRow& row = pack.rows(stream)[i];
    if (decoder.count() - before != row.adds)
      return fail(name,
                  "adds " + std::to_string(decoder.count() - before) + ", its row says " + std::to_string(row.adds));
    blocks++;
  }
  if (!decoder.complete()) return fail("", "is not complete after its last block");
  return {};
}

}  // namespace

Verification verify_pack(const OpenedPack& pack) {
  Verification verification;
  auto note = [&](const std::string& where, const Result<void>& result) {
    if (result) return;
    const std::string message = result.error().message();
    verification.errors.push_back(where.empty() ? message : where + ": " + message);
  };
  const PackReader& reader = pack.reader();
  note("JSON", verify_json(pack));
  for (size_t i = 0; i < reader.directory().streams.size(); i++)
    note("stream " + std::to_string(i) + " (" + to_text(reader.directory().streams[i].kind) + ")",
         verify_stream(reader, i, verification.blocks));
  note("", reader.verify_id());
  if (verification.errors.empty()) note("scene", verify_scene(pack));
  return verification;
}

}  // namespace lightwell
