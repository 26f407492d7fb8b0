// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/obj_text.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "lightwell/scene/place.h"

namespace lightwell {
namespace {

constexpr size_t most_corners = 255;

constexpr std::string_view spaces = " \t\r\v\f";

std::string_view text_of(Bytes bytes) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

std::string_view trimmed(std::string_view text) {
  const size_t start = text.find_first_not_of(spaces);
  if (start == text.npos) return {};
  return text.substr(start, text.find_last_not_of(spaces) + 1 - start);
}

/// Takes the first word off a text; empty at its end.
std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const size_t length = std::min(text.find_first_of(spaces), text.size());
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

/// The next line of a text, joined with the lines that continue it after a backslash. `lines` counts them.
std::string take_line(std::string_view& text, size_t& lines) {
  std::string line;
  while (!text.empty()) {
    const size_t length = std::min(text.find('\n'), text.size());
    std::string_view part = text.substr(0, length);
    text.remove_prefix(std::min(length + 1, text.size()));
    lines++;
    if (part.ends_with('\r')) part.remove_suffix(1);
    const bool continues = part.ends_with('\\');
    if (continues) part.remove_suffix(1);
    line += part;
    if (!continues) break;
    line += ' ';
  }
  return line;
}

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

/// True for words that begin with a number, as the library reads them.
bool is_number(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  double value;
  return !word.empty() && (word[0] == '.' || (word[0] >= '0' && word[0] <= '9')) &&
         std::from_chars(word.data(), word.data() + word.size(), value).ec == std::errc();
}

bool begins_with_numbers(std::string_view words, int count) {
  for (int i = 0; i < count; i++) {
    if (!is_number(take_word(words))) return false;
  }
  return true;
}

double number_of(std::string_view word) {
  double value = 0;
  if (word.starts_with('+')) word.remove_prefix(1);
  std::from_chars(word.data(), word.data() + word.size(), value);
  return value;
}

/// The position of a checked line "v x y z"; what follows it is left.
Vec3d take_position(std::string_view& line) {
  take_word(line);
  Vec3d position;
  for (double& x : position.e) x = number_of(take_word(line));
  return position;
}

std::string text_of(double number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

bool is_index(std::string_view word) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && value != 0;
}

/// A corner without the slashes behind which nothing stands, as in "1//" and "1/2/".
std::string_view without_empty_indices(std::string_view word) { return word.substr(0, word.find_last_not_of('/') + 1); }

/// "1", "1/2", "1/2/3" or "1//3", where each number may be negative but not zero.
bool is_corner(std::string_view word) {
  const size_t first = std::min(word.find('/'), word.size());
  if (!is_index(word.substr(0, first))) return false;
  if (first == word.size()) return true;
  word.remove_prefix(first + 1);
  const size_t second = std::min(word.find('/'), word.size());
  const bool has_normal = second < word.size();
  if (!is_index(word.substr(0, second)) && !(second == 0 && has_normal)) return false;
  return !has_normal || is_index(word.substr(second + 1));
}

/// A face in the form that the library reads, or the reason why its corners cannot be read.
Result<std::string> checked_face(std::string_view corners) {
  size_t count = 0;
  std::string face = "f";
  for (std::string_view word = take_word(corners); !word.empty(); word = take_word(corners), count++) {
    // At most two slashes, whatever is between them.
    if (std::count(word.begin(), word.end(), '/') > 2) return fail("", "a face's corner that is no index");
    word = without_empty_indices(word);
    if (!is_corner(word)) return fail("", "a face's corner that is no index");
    face += ' ';
    face += word;
  }
  if (count > most_corners) return fail("", "a face of " + std::to_string(count) + " corners; 255 are the most");
  return face;
}

std::string with_underscores(std::string_view name) {
  std::string joined(trimmed(name));
  std::replace_if(
      joined.begin(), joined.end(), [](char c) { return spaces.find(c) != spaces.npos; }, '_');
  return joined;
}

/// A file's name, whose spaces the library wants escaped.
std::string with_escapes(std::string_view name) {
  std::string escaped;
  for (const char c : trimmed(name)) {
    if (c == ' ') escaped += '\\';
    escaped += c == '\\' ? '/' : c;
  }
  return escaped;
}

/// A keyword of an MTL file in the library's spelling: exporters write map_KD, Map_Kd and others.
std::string_view as_the_library_spells(std::string_view word) {
  constexpr std::string_view keywords[] = {"newmtl", "Ka",     "Kd",     "Ks",     "Ke",     "Ns",    "d",    "Tr",
                                           "illum",  "map_Ka", "map_Kd", "map_Ks", "map_Ke", "map_d", "bump", "norm"};
  const auto lower = [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); };
  for (const std::string_view keyword : keywords)
    if (std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                   [&](char a, char b) { return lower(a) == lower(b); }))
      return keyword;
  return word;
}

bool is_left_out_with_warning(std::string_view keyword) {
  constexpr std::string_view keywords[] = {"p", "l", "curv", "curv2", "surf"};
  return std::find(std::begin(keywords), std::end(keywords), keyword) != std::end(keywords);
}

/// One statement in the form that the library reads correctly, or its fault.
Result<std::string> checked_statement(std::string_view line, Report& report) {
  std::string_view rest = line;
  const std::string_view keyword = take_word(rest);
  if (keyword == "v" || keyword == "vn" || keyword == "vt") {
    rest = without_comment(rest);
    if (!begins_with_numbers(rest, keyword == "vt" ? 1 : 3)) return fail("", "a vertex with too few numbers");
    return std::string(keyword) + " " + std::string(trimmed(rest));
  }
  if (keyword == "f") return checked_face(without_comment(rest));
  if (keyword == "o" || keyword == "g" || keyword == "usemtl") {
    const std::string name = with_underscores(rest);
    return std::string(keyword) + " " + (name.empty() ? "unnamed" : name);
  }
  if (keyword == "mtllib") return "mtllib " + with_escapes(rest);
  if (is_left_out_with_warning(keyword)) report.warn("points, lines and curves are left out");
  return std::string();
}

}  // namespace

bool is_obj(Bytes bytes) {
  constexpr std::string_view keywords[] = {"v", "vn", "vt", "f", "o", "g", "s", "l", "p", "mtllib", "usemtl"};
  std::string_view text = text_of(bytes);
  size_t lines = 0;
  while (!text.empty()) {
    const std::string line = take_line(text, lines);
    std::string_view rest = line;
    const std::string_view keyword = take_word(rest);
    if (keyword.empty() || keyword.starts_with('#')) continue;
    return std::find(std::begin(keywords), std::end(keywords), keyword) != std::end(keywords);
  }
  return false;
}

Result<std::string> checked_obj_text(Bytes file, Report& report) {
  std::string_view text = text_of(file);
  if (text.find('\0') != text.npos) return fail("", "holds zero bytes, so it is no text");
  std::string checked;
  checked.reserve(text.size());
  for (size_t lines = 0; !text.empty();) {
    const size_t before = lines;
    const std::string line = take_line(text, lines);
    const auto statement = checked_statement(line, report);
    if (!statement) return fail("line " + std::to_string(before + 1), statement.error().reason);
    checked += *statement;
    checked.append(lines - before, '\n');
  }
  return checked;
}

Vec3d move_to_origin(std::string& checked) {
  std::vector<Vec3d> positions;
  const auto for_each_line = [&](const auto& visit) {
    for (std::string_view text = checked; !text.empty();) {
      const std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(line.size() + 1, text.size()));
      visit(line);
    }
  };
  for_each_line([&](std::string_view line) {
    if (line.starts_with("v ")) positions.push_back(take_position(line));
  });
  const Vec3d origin = origin_amid(positions);
  if (origin == Vec3d{}) return origin;
  std::string moved;
  moved.reserve(checked.size());
  for_each_line([&](std::string_view line) {
    if (line.starts_with("v ")) {
      moved += "v";
      for (const double x : (take_position(line) - origin).e) moved += ' ' + text_of(x);
    }
    moved.append(line) += '\n';
  });
  checked = std::move(moved);
  return origin;
}

std::string checked_mtl_text(Bytes file) {
  std::string_view text = text_of(file);
  std::string checked;
  for (size_t lines = 0; !text.empty();) {
    const std::string line = take_line(text, lines);
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    const std::string_view keyword = as_the_library_spells(word);
    if (keyword == "newmtl") {
      checked += "newmtl " + with_underscores(rest);
    } else {
      std::string value(trimmed(rest));
      if (keyword.starts_with("map_")) std::replace(value.begin(), value.end(), '\\', '/');
      checked += std::string(keyword) + ' ' + value;
    }
    checked += '\n';
  }
  return checked;
}

}  // namespace lightwell
