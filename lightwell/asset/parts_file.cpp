// SPDX-License-Identifier: Apache-2.0
//
// The parts codec parts_codec_gzip: a gzip file cut into blocks.
#include "lightwell/asset/parts_asset.h"

namespace lightwell {

std::vector<uint8_t> PartsParameters::write() const {
  ByteWriter writer;
  writer.u32(bytes);
  writer.u32(inflated);
  return writer.release();
}

Result<PartsParameters> PartsParameters::read(Bytes bytes) {
  ByteReader reader(bytes);
  PartsParameters parameters;
  parameters.bytes = reader.u32();
  parameters.inflated = reader.u32();
  if (!reader.ok() || reader.remaining() > 0) return fail("parameters", "wrong length");
  if (!parameters.possible()) return fail("parameters", "promise more bytes than the stream has");
  return parameters;
}

Result<std::unique_ptr<AssetDecoder>> open_parts_file(const AssetSource& source) {
  LW_TRY(parameters, PartsParameters::read(source.entry.parameters));
  LW_CHECK(spend_on_file(source, parameters.bytes));
  return std::make_unique<PartsAsset>(source.asset, parameters);
}

}  // namespace lightwell
