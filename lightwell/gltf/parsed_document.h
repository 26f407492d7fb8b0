// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"

namespace lightwell {

/// read_document for JSON that is parsed already, and the data of a GLB's BIN chunk: what the JSON refers to lies in
/// there or in data URIs.
Result<Document> read_document(Json json, Bytes bin, Report& report);

}  // namespace lightwell
