// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/figures_text.h"

#include <map>

#include "lightwell/cli/number_text.h"

namespace lightwell {
namespace {

using Figures = nlohmann::ordered_json;

enum class Unit { none, seconds, bytes, share };

// How a JSON key is named in the text, and its unit; an unknown key keeps its name and has the unit of its object.
struct Meaning {
  std::string name;
  Unit unit = Unit::none;
};

Meaning meaning_of(const std::string& key, Unit outer) {
  static const std::map<std::string, Meaning> known = {
      {"seconds", {"time", Unit::seconds}},
      {"bytes", {"size", Unit::bytes}},
      {"pack_bytes", {"size of the pack", Unit::bytes}},
      {"expected_memory", {"expected memory", Unit::bytes}},
      {"peak_memory", {"peak memory", Unit::bytes}},
      {"rays_per_second", {"rays a second"}},
      {"first_picture", {"first picture"}},
      {"refined_to", {"cells of the light grid refined up to"}},
      {"resumed_nodes", {"nodes known from the run before"}},
      {"estimated_error", {"estimated error of the irradiance, root mean square", Unit::share}},
      {"grids", {"light grids"}},
      {"cell", {"cells in metres"}},
      {"estimate", {"of it", Unit::share}},
      {"surface", {"on surfaces", Unit::share}},
      {"free", {"in free space", Unit::share}},
      {"spp", {"samples a pixel"}}};
  const auto found = known.find(key);
  return found == known.end() ? Meaning{key, outer} : found->second;
}

std::string number_text(const Figures& number, Unit unit) {
  switch (unit) {
    case Unit::seconds: {
      char text[64];
      std::snprintf(text, sizeof text, "%.2f s", number.get<double>());
      return text;
    }
    case Unit::bytes: return size_text(number.get<uint64_t>());
    case Unit::share: return short_number(100 * number.get<double>()) + " %";
    case Unit::none: break;
  }
  return number.is_number_unsigned() ? grouped(number.get<uint64_t>()) : short_number(number.get<double>());
}

std::string value_text(const Figures& value, Unit unit) {
  if (value.is_number()) return number_text(value, unit);
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return value.get<std::string>();
  std::string text;
  if (value.is_array()) {
    const std::string between = !value.empty() && value[0].is_object() ? "; " : " ";
    for (const Figures& item : value) text += (text.empty() ? "" : between) + value_text(item, unit);
    return text;
  }
  for (const auto& [key, item] : value.items()) {
    if (item.is_null()) continue;
    const Meaning meaning = meaning_of(key, unit);
    text += (text.empty() ? "" : ", ") + meaning.name + " " + value_text(item, meaning.unit);
  }
  return text;
}

}  // namespace

std::string figures_text(const Figures& figures) {
  std::string text;
  for (const auto& [key, value] : figures.items()) {
    if (value.is_null()) continue;
    const Meaning meaning = meaning_of(key, Unit::none);
    text += meaning.name + ": " + value_text(value, meaning.unit) + "\n";
  }
  return text;
}

}  // namespace lightwell
