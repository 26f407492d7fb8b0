// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lightwell/server/byte_range.h"
#include "lightwell/server/catalog.h"

namespace lightwell {

/// The parts of a request's header on which its answer depends.
struct RequestHead {
  std::string method;
  std::string target;  ///< a path, with or without a query, or a whole URL (RFC 9112, 3.2)
  std::string range;
  std::string if_range;
  std::string if_match;
  std::string if_none_match;
  std::string accept_encoding;
};

/// An answer, without the fields that belong to the connection.
struct Answer {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> fields;
  std::shared_ptr<const std::string> text;  ///< what the body is a part of, unless a file is open
  OpenFile file;
  /// The body is bytes first ... first + length - 1 of the text or file.
  uint64_t first = 0;
  uint64_t length = 0;   ///< of the body; Content-Length
  bool has_body = true;  ///< false: for HEAD and for status 204 and 304

  void add(std::string name, std::string value) { fields.emplace_back(std::move(name), std::move(value)); }
};

/// Answers a request from a catalog. Status 503 says that the system has no descriptors left for what is there.
Answer answer_request(Catalog& catalog, const RequestHead& request);

/// An answer that is a text.
Answer answer_text(int status, std::shared_ptr<const std::string> text, std::string type);
/// An answer that is a sentence.
Answer answer_text(int status, std::string text);

}  // namespace lightwell
