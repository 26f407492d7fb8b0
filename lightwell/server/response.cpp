// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/response.h"

#include <fcntl.h>

namespace lightwell {
namespace {

bool names_tag(std::string_view list, std::string_view etag) {
  return list == "*" || list.find(etag) != std::string_view::npos;
}

/// The file, or the part of it that was asked for (RFC 9110, 14).
Answer answer_file(const std::filesystem::path& path, const RequestHead& request) {
  OpenFile file(path);
  if (!file.is_open()) return answer_text(404, "not found\n");
  const std::string etag = file.etag();
  Answer answer;
  answer.add("Content-Type", std::string(content_type(path)));
  answer.add("Accept-Ranges", "bytes");
  answer.add("ETag", etag);
  answer.add("Cache-Control", "no-cache");
  if (names_tag(request.if_none_match, etag)) {
    answer.status = 304;
    answer.has_body = false;
    return answer;
  }
  const bool same = request.if_range.empty() || request.if_range == etag;
  const ByteRange range = parse_range(same ? request.range : "", file.length());
  const std::string total = std::to_string(file.length());
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
  answer.first = range.first;
  answer.length = range.length;
  answer.file = std::move(file);
  return answer;
}

Answer answer_preflight() {
  Answer answer;
  answer.status = 204;
  answer.has_body = false;
  answer.add("Access-Control-Allow-Methods", "GET, HEAD");
  answer.add("Access-Control-Allow-Headers", "Range, If-Range, If-None-Match");
  answer.add("Access-Control-Max-Age", "86400");
  return answer;
}

Answer answer_method(const Catalog& catalog, const RequestHead& request) {
  if (request.method == "OPTIONS") return answer_preflight();
  if (request.method != "GET" && request.method != "HEAD") {
    Answer refusal = answer_text(405, "only GET and HEAD\n");
    refusal.add("Allow", "GET, HEAD, OPTIONS");
    return refusal;
  }
  const std::string_view target = request.target;
  const std::string_view path = target.substr(0, target.find('?'));
  if (path == "/healthz") return answer_text(200, "ok\n");
  if (path == "/packs.json") return answer_text(200, catalog.packs_json(), "application/json");
  const auto file = catalog.file(path);
  return file ? answer_file(*file, request) : answer_text(404, "not found\n");
}

}  // namespace

OpenFile::OpenFile(const std::filesystem::path& path) {
  const int opened = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (opened < 0) return;
  if (::fstat(opened, &stat_) == 0 && S_ISREG(stat_.st_mode))
    descriptor_ = opened;
  else
    ::close(opened);
}

std::string OpenFile::etag() const {
  std::string tag = "\"";
  for (const auto number :
       {static_cast<uint64_t>(stat_.st_dev), static_cast<uint64_t>(stat_.st_ino), length(),
        static_cast<uint64_t>(stat_.st_mtim.tv_sec), static_cast<uint64_t>(stat_.st_mtim.tv_nsec)}) {
    if (tag.size() > 1) tag += '-';
    tag += std::to_string(number);
  }
  return tag + '"';
}

Answer answer_text(int status, std::string text, std::string type) {
  Answer answer;
  answer.status = status;
  answer.length = text.size();
  answer.text = std::move(text);
  answer.add("Content-Type", std::move(type));
  answer.add("Cache-Control", "no-store");
  return answer;
}

Answer answer_request(const Catalog& catalog, const RequestHead& request) {
  Answer answer = answer_method(catalog, request);
  if (request.method == "HEAD") answer.has_body = false;
  answer.add("Access-Control-Allow-Origin", "*");
  answer.add("Access-Control-Expose-Headers", "Content-Range, ETag, Accept-Ranges");
  answer.add("Cross-Origin-Resource-Policy", "cross-origin");
  answer.add("X-Content-Type-Options", "nosniff");
  return answer;
}

}  // namespace lightwell
