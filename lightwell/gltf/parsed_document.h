// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"

namespace lightwell {

/// read_document for the parsed JSON of a GLB and the data of its BIN chunk. The JSON should refer only to that chunk
/// and to data URIs: relative URIs are resolved against the working directory.
Result<Document> read_document(Json json, Bytes bin, Report& report);

}  // namespace lightwell
