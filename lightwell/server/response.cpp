// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/response.h"

#include <algorithm>

#include "lightwell/server/field_list.h"

namespace lightwell {
namespace {

Answer answer_failure(const Error& error) {
  if (error.kind != ErrorKind::limit) return answer_text(404, "not found\n");
  Answer answer = answer_text(503, "too many files are open\n");
  answer.add("Retry-After", "1");
  return answer;
}

/// The path of a request's target. One in absolute form ("http://host/path") has a scheme and a host before it, which
/// this server takes for its own.
std::string_view path_of(std::string_view target) {
  constexpr std::string_view mark = "://";
  const size_t colon = std::min(target.find(mark), target.size());
  const bool has_scheme = colon > 0 && std::ranges::all_of(target.substr(0, colon), [](char c) {
                            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
                          });
  if (has_scheme && colon < target.size()) {
    target.remove_prefix(colon + mark.size());
    target.remove_prefix(std::min(target.find_first_of("/?"), target.size()));
  }
  const std::string_view path = target.substr(0, target.find('?'));
  return path.empty() ? "/" : path;
}

/// The file's representation of another content coding has another tag (RFC 9110, 8.8.3.3).
std::string gzip_tag(const std::string& etag) { return etag.substr(0, etag.size() - 1) + "-gzip\""; }

/// What an answer is made from: a file as it is, or its gzipped content.
struct Representation {
  Catalog::File found;
  std::shared_ptr<const std::string> gzipped;  ///< null: the file as it is

  uint64_t length() const { return gzipped ? gzipped->size() : found.open.length(); }
  std::string etag() const { return gzipped ? gzip_tag(found.open.etag()) : found.open.etag(); }
};

/// A part that is asked for is one of the file as it is: that is what who knows a part already knows parts of.
Representation choose_representation(Catalog& catalog, Catalog::File found, const RequestHead& request) {
  const bool gzipped = found.compressible && request.range.empty() && accepts_gzip(request.accept_encoding);
  auto content = gzipped ? catalog.gzipped(found.open) : nullptr;
  return {std::move(found), std::move(content)};
}

/// The file, or the part of it that was asked for. A range has a meaning for GET alone (RFC 9110, 14.2).
Answer answer_file(Representation chosen, const RequestHead& request) {
  const std::string etag = chosen.etag();
  Answer answer;
  answer.add("Content-Type", std::string(chosen.found.type));
  answer.add("Accept-Ranges", "bytes");
  answer.add("ETag", etag);
  answer.add("Cache-Control", "no-cache");
  if (chosen.found.compressible) answer.add("Vary", "Accept-Encoding");
  if (!request.if_match.empty() && !names_strong_tag(request.if_match, etag))
    return answer_text(412, "the file has another tag\n");
  if (names_tag(request.if_none_match, etag)) {
    answer.status = 304;
    answer.has_body = false;
    return answer;
  }
  const bool meant = request.method == "GET" && (request.if_range.empty() || request.if_range == etag);
  const ByteRange range = parse_range(meant ? request.range : "", chosen.length());
  const std::string total = std::to_string(chosen.length());
  if (range.kind == ByteRange::Kind::unsatisfiable) {
    Answer refusal = answer_text(416, "the range is beyond the end of the file\n");
    refusal.add("Content-Range", "bytes */" + total);
    return refusal;
  }
  if (range.kind == ByteRange::Kind::part) {
    answer.status = 206;
    answer.add("Content-Range", "bytes " + std::to_string(range.first) + "-" +
                                    std::to_string(range.first + range.length - 1) + "/" + total);
  }
  if (chosen.gzipped) answer.add("Content-Encoding", "gzip");
  answer.first = range.first;
  answer.length = range.length;
  answer.text = std::move(chosen.gzipped);
  if (!answer.text) answer.file = std::move(chosen.found.open);
  return answer;
}

Answer answer_preflight() {
  Answer answer;
  answer.status = 204;
  answer.has_body = false;
  answer.add("Access-Control-Allow-Methods", "GET, HEAD");
  answer.add("Access-Control-Allow-Headers", "Range, If-Range, If-Match, If-None-Match");
  answer.add("Access-Control-Max-Age", "86400");
  return answer;
}

Answer answer_method(Catalog& catalog, const RequestHead& request) {
  if (request.method == "OPTIONS") return answer_preflight();
  if (request.method != "GET" && request.method != "HEAD") {
    Answer refusal = answer_text(405, "only GET and HEAD\n");
    refusal.add("Allow", "GET, HEAD, OPTIONS");
    return refusal;
  }
  const std::string_view path = path_of(request.target);
  if (path == "/healthz") return answer_text(200, "ok\n");
  if (path == "/packs.json") {
    auto list = catalog.packs_json();
    return list ? answer_text(200, std::move(*list), "application/json") : answer_failure(list.error());
  }
  auto file = catalog.file(path);
  if (!file) return answer_failure(file.error());
  return answer_file(choose_representation(catalog, std::move(*file), request), request);
}

}  // namespace

Answer answer_text(int status, std::shared_ptr<const std::string> text, std::string type) {
  Answer answer;
  answer.status = status;
  answer.length = text->size();
  answer.text = std::move(text);
  answer.add("Content-Type", std::move(type));
  answer.add("Cache-Control", "no-store");
  return answer;
}

Answer answer_text(int status, std::string text) {
  return answer_text(status, std::make_shared<const std::string>(std::move(text)), "text/plain; charset=utf-8");
}

Answer answer_request(Catalog& catalog, const RequestHead& request) {
  Answer answer = answer_method(catalog, request);
  if (request.method == "HEAD") answer.has_body = false;
  answer.add("Access-Control-Allow-Origin", "*");
  answer.add("Access-Control-Expose-Headers", "Content-Range, ETag, Accept-Ranges");
  answer.add("Cross-Origin-Resource-Policy", "cross-origin");
  answer.add("X-Content-Type-Options", "nosniff");
  return answer;
}

}  // namespace lightwell
