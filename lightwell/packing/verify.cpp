// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/verify.h"

#include "lightwell/asset/codecs.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify_json.h"
#include "lightwell/packing/verify_scene.h"

namespace lightwell {
namespace {

// Decodes a whole stream and compares each block with its row. All streams share a client's memory budget.
Result<void> verify_stream(const PackReader& pack, uint32_t stream, AssetContext& context, uint64_t& blocks) {
  const std::string name = "stream " + std::to_string(stream);
  LW_TRY(decoder, open_asset(pack.directory(), stream, context));
  for (uint32_t i = 0; i < pack.directory().streams[stream].blocks; i++) {
    const std::string block = name + ", block " + std::to_string(i);
    LW_TRY(payload, pack.block(stream, i));
    const uint64_t before = decoder->added();
    if (const auto appended = decoder->append(payload); !appended) return fail(block, appended.error().message());
    const uint64_t added = decoder->added() - before;
    const BlockRow& row = pack.rows(stream)[i];
    if (added != row.adds)
      return fail(block, "adds " + std::to_string(added) + ", its row says " + std::to_string(row.adds));
    blocks++;
  }
  if (!decoder->complete()) return fail(name, "is not complete after its last block");
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
  AssetContext context{.bin = pack.bin()};
  for (uint32_t i = 0; i < reader.directory().streams.size(); i++)
    note("", verify_stream(reader, i, context, verification.blocks));
  note("", reader.verify_id());
  if (verification.errors.empty()) note("scene", verify_scene(pack));
  return verification;
}

}  // namespace lightwell
