// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/ply_header.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace lightwell {
namespace {

// More than any program writes, and little enough to hold.
constexpr size_t longest_line = 4096;
constexpr size_t most_properties = 4096;
constexpr size_t most_textures = 4096;

/// Takes the header's lines off the front of a text. All end as the first one does.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    const size_t end = text.find_first_of("\r\n");
    if (end != text.npos && text.substr(end).starts_with('\r') && !text.substr(end).starts_with("\r\n")) ending_ = '\r';
  }

  /// The next line without its end; none when there is none or it is too long.
  std::optional<std::string_view> next() {
    const size_t length = text_.substr(at_, longest_line).find(ending_);
    if (length == text_.npos) return std::nullopt;
    std::string_view line = text_.substr(at_, length);
    at_ += length + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  size_t position() const { return at_; }

 private:
  std::string_view text_;
  size_t at_ = 0;
  char ending_ = '\n';
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const size_t start = line.find_first_not_of(" \t");
    if (start == line.npos) return words;
    line.remove_prefix(start);
    const size_t length = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

/// The rest of a line "comment TextureFile NAME"; names may hold spaces.
std::optional<std::string> texture_named(std::string_view line) {
  for (const std::string_view word : {"comment", "texturefile"}) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
    if (line.size() <= word.size() ||
        !std::equal(word.begin(), word.end(), line.begin(), [&](char b, char a) { return same(a, b); }))
      return std::nullopt;
    line.remove_prefix(word.size());
    if (!line.starts_with(' ') && !line.starts_with('\t')) return std::nullopt;
  }
  const size_t first = line.find_first_not_of(" \t"), last = line.find_last_not_of(" \t");
  if (first == line.npos) return std::nullopt;
  return std::string(line.substr(first, last + 1 - first));
}

std::optional<PlyType> type_named(std::string_view name) {
  constexpr std::pair<std::string_view, PlyType> names[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const auto& [known, type] : names) {
    if (name == known) return type;
  }
  return std::nullopt;
}

tl::unexpected<Error> not_understood(std::string_view line) {
  std::string shown(line.substr(0, 60));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return fail("header", "\"" + shown + "\" is not understood");
}

Result<PlyFormat> format_named(std::string_view name) {
  if (name == "ascii") return PlyFormat::ascii;
  if (name == "binary_little_endian") return PlyFormat::little_endian;
  if (name == "binary_big_endian") return PlyFormat::big_endian;
  return not_understood(name);
}

Result<PlyElement> element_of(std::string_view line, const std::vector<std::string_view>& words) {
  PlyElement element;
  if (words.size() != 3) return not_understood(line);
  element.name = words[1];
  const std::string_view count = words[2];
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (error != std::errc() || end != count.data() + count.size()) return not_understood(line);
  return element;
}

Result<PlyProperty> property_of(std::string_view line, const std::vector<std::string_view>& words) {
  PlyProperty property;
  property.is_list = words.size() == 5 && words[1] == "list";
  if (!property.is_list && words.size() != 3) return not_understood(line);
  const auto type = type_named(words[words.size() - 2]);
  const auto count_type = property.is_list ? type_named(words[2]) : PlyType::uint8;
  if (!type || !count_type) return not_understood(line);
  property.name = words.back();
  property.type = *type;
  property.count_type = *count_type;
  return property;
}

/// The fewest bytes that an element can take.
size_t least_size(const PlyElement& element, PlyFormat format) {
  size_t size = 0;
  for (const PlyProperty& property : element.properties)
    size += format == PlyFormat::ascii ? 2 : size_of(property.is_list ? property.count_type : property.type);
  return size;
}

/// Holds the announced counts against the bytes that follow, before anyone believes them.
Result<void> check_counts(const PlyHeader& header, size_t available) {
  // The last number of a text needs no space after it.
  if (header.format == PlyFormat::ascii) available++;
  for (const PlyElement& element : header.elements) {
    const size_t size = least_size(element, header.format);
    if (size == 0) continue;
    if (element.count > available / size)
      return fail("header", "announces " + std::to_string(element.count) + " of \"" + element.name +
                                "\", more than the file can hold");
    available -= element.count * size;
  }
  return {};
}

}  // namespace

size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32: return 4;
    case PlyType::float64: return 8;
  }
  return 0;
}

Result<PlyHeader> read_ply_header(Bytes file) {
  Lines lines({reinterpret_cast<const char*>(file.data()), file.size()});
  if (words_of(lines.next().value_or("")) != std::vector<std::string_view>{"ply"}) return fail("header", "is no PLY");
  PlyHeader header;
  bool has_format = false;
  size_t properties = 0;
  while (const auto line = lines.next()) {
    const auto words = words_of(*line);
    if (auto texture = texture_named(*line)) header.textures.push_back(std::move(*texture));
    if (header.textures.size() > most_textures) return fail(ErrorKind::limit, "header", "names too many textures");
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") {
      header.size = lines.position();
      if (!has_format) return fail("header", "names no format");
      LW_CHECK(check_counts(header, file.size() - header.size));
      return header;
    }
    if (words[0] == "format" && words.size() == 3) {
      LW_TRY(format, format_named(words[1]));
      header.format = format;
      has_format = true;
    } else if (words[0] == "element") {
      LW_TRY(element, element_of(*line, words));
      header.elements.push_back(std::move(element));
    } else if (words[0] == "property" && !header.elements.empty()) {
      LW_TRY(property, property_of(*line, words));
      header.elements.back().properties.push_back(std::move(property));
      if (++properties > most_properties) return fail(ErrorKind::limit, "header", "has too many properties");
    } else {
      return not_understood(*line);
    }
  }
  return fail("header", "does not end");
}

}  // namespace lightwell
