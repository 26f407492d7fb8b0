// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/deformation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "lightwell/gltf/document.h"
#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

constexpr int array_buffer = 34962;

bool bends(const std::string& semantic) { return semantic.starts_with("JOINTS_") || semantic.starts_with("WEIGHTS_"); }

// The semantics of morph targets that a pack keeps: it has no tangents. Each target has all that any has, since
// three.js takes a missing displacement for the attribute itself.
constexpr std::array displaced = {"POSITION", "NORMAL"};

Bytes bytes_of(const std::vector<uint32_t>& values) {
  return {reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(uint32_t)};
}

void state_bounds(Json& accessor, std::span<const uint8_t> elements, bool with_zero) {
  Box3f box;
  if (with_zero) box.extend(Vec3f{});
  for (size_t at = 0; at < elements.size(); at += sizeof(Vec3f)) {
    Vec3f value;
    std::memcpy(&value, &elements[at], sizeof value);
    box.extend(value);
  }
  accessor["min"] = to_json(box.lo);
  accessor["max"] = to_json(box.hi);
}

bool is_zero(const uint8_t* element, size_t size) {
  return std::all_of(element, element + size, [](uint8_t byte) { return byte == 0; });
}

bool is_weight(float weight) { return weight > 0 && std::isfinite(weight); }

// Weights as whole numbers that add up to 65535; those of nothing are all of the first.
std::vector<uint16_t> shares_of(const std::vector<float>& weights) {
  double total = 0;
  for (const float weight : weights) total += is_weight(weight) ? weight : 0;
  std::vector<uint16_t> shares(weights.size());
  int left = 65535;
  for (size_t i = 0; i < weights.size(); i++) {
    if (is_weight(weights[i])) shares[i] = static_cast<uint16_t>(std::lround(65535 * (weights[i] / total)));
    left -= shares[i];
  }
  uint16_t& largest = *std::ranges::max_element(shares);
  largest = static_cast<uint16_t>(largest + left);
  return shares;
}

// Visits every accessor with the place in a primitive where one of its kind stands.
template <typename Visit>
Result<void> for_each(const DeformationAccessors& accessors, const Visit& visit) {
  for (const auto& [semantic, accessor] : accessors.attributes)
    LW_CHECK(visit(Json::json_pointer("/attributes") / semantic, semantic, accessor));
  for (size_t i = 0; i < accessors.targets.size(); i++)
    for (const auto& [semantic, accessor] : accessors.targets[i])
      LW_CHECK(visit(Json::json_pointer("/targets") / i / semantic, semantic, accessor));
  return {};
}

}  // namespace

Result<Deformation> Deformation::read(const Document& document, const Json& primitive, size_t rows,
                                      const std::string& name) {
  Deformation read;
  read.rows_ = rows;
  for (const auto& [semantic, accessor] : member(primitive, "attributes").items()) {
    if (!bends(semantic)) continue;
    LW_TRY(data, locate(document, static_cast<int>(whole_number(accessor))));
    std::string place = name + ".attributes.";
    place += semantic;
    if (data.type.rows != 4 || data.type.columns != 1 || data.count != rows)
      return fail(place, "is of a type or count that it cannot have");
    read.attributes_.push_back({semantic, data.type, std::vector<uint8_t>(rows * data.type.size())});
    Array& array = read.attributes_.back();
    for (size_t i = 0; i < rows; i++)
      std::memcpy(&array.elements[i * data.type.size()], data.bytes.data() + i * data.stride, data.type.extent());
  }
  read.shorten_weights();
  const Json& targets = member(primitive, "targets");
  for (const Json& target : targets) {
    read.targets_.emplace_back();
    for (const char* semantic : displaced) {
      if (std::ranges::none_of(targets, [&](const Json& other) { return other.contains(semantic); })) continue;
      const int accessor = index_of(target, semantic);
      std::vector<Vec3f> values(rows);
      if (accessor >= 0) {
        LW_TRY(stored, read_sparse_vectors(document, accessor, rows));
        values = std::move(stored);
      }
      Array array{semantic, {Component::f32, 3}, std::vector<uint8_t>(rows * sizeof(Vec3f))};
      for (Vec3f& value : values) value = is_finite(value) ? value + Vec3f{} : Vec3f{};  // -0 becomes 0
      std::memcpy(array.elements.data(), values.data(), array.elements.size());
      read.targets_.back().push_back(std::move(array));
    }
  }
  return read;
}

// Weights as floats, which most files have, in half their bytes: as 16-bit shares, which for each vertex add up to one.
// What has no weight follows the first joint of its skin (gltf/pose.h).
void Deformation::shorten_weights() {
  std::vector<Array*> sets, joints;
  for (Array& array : attributes_) (array.semantic.starts_with("WEIGHTS_") ? sets : joints).push_back(&array);
  if (std::ranges::any_of(sets, [](const Array* set) { return set->type.component != Component::f32; })) return;
  std::vector<float> weights(4 * sets.size());
  std::vector<std::vector<uint8_t>> shares(sets.size());
  for (uint32_t row = 0; !sets.empty() && row < rows_; row++) {
    for (size_t set = 0; set < sets.size(); set++) std::memcpy(&weights[4 * set], sets[set]->row(row), sizeof(Vec4f));
    const std::vector<uint16_t> rounded = shares_of(weights);
    if (std::ranges::none_of(weights, is_weight))
      for (Array* array : joints) std::fill_n(&array->elements[row * array->type.size()], array->type.size(), 0);
    for (size_t set = 0; set < sets.size(); set++) {
      const auto* first = reinterpret_cast<const uint8_t*>(&rounded[4 * set]);
      shares[set].insert(shares[set].end(), first, first + 4 * sizeof(uint16_t));
    }
  }
  for (size_t set = 0; set < sets.size(); set++) {
    sets[set]->type.component = Component::u16;
    sets[set]->type.normalized = true;
    sets[set]->elements = std::move(shares[set]);
  }
}

bool Deformation::has(const std::string& attribute) const {
  return std::ranges::any_of(attributes_, [&](const Array& array) { return array.semantic == attribute; });
}

bool Deformation::alike(uint32_t a, uint32_t b) const {
  const auto same = [&](const Array& array) { return std::memcmp(array.row(a), array.row(b), array.type.size()) == 0; };
  return std::ranges::all_of(attributes_, same) &&
         std::ranges::all_of(targets_, [&](const auto& target) { return std::ranges::all_of(target, same); });
}

std::vector<uint32_t> Deformation::first_alike() const {
  std::vector<uint32_t> order(rows_), first(rows_);
  std::iota(order.begin(), order.end(), 0u);
  const auto compare = [&](uint32_t a, uint32_t b, const Array& array) {
    return std::memcmp(array.row(a), array.row(b), array.type.size());
  };
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    for (const Array& array : attributes_)
      if (const int sign = compare(a, b, array)) return sign < 0;
    for (const auto& target : targets_)
      for (const Array& array : target)
        if (const int sign = compare(a, b, array)) return sign < 0;
    return a < b;
  });
  for (size_t i = 0; i < order.size(); i++)
    first[order[i]] = i > 0 && alike(order[i - 1], order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

int Deformation::write(Document& document, const Array& array, std::span<const uint32_t> rows) const {
  DocumentBuilder builder(document);
  const bool target = array.type.rows == 3;
  const size_t size = array.type.size();
  Json accessor = {{"componentType", static_cast<int>(array.type.component)},
                   {"count", rows.size()},
                   {"type", target ? "VEC3" : "VEC4"}};
  if (array.type.normalized) accessor["normalized"] = true;
  std::vector<uint8_t> elements;
  std::vector<uint32_t> places;  // of the elements that are not zero
  for (uint32_t i = 0; i < rows.size(); i++) {
    const uint8_t* element = array.row(rows[i]);
    elements.insert(elements.end(), element, element + size);
    if (target && !is_zero(element, size)) places.push_back(i);
  }
  const bool sparse = target && places.size() * (size + sizeof(uint32_t)) < elements.size();
  if (sparse) {
    elements.clear();
    for (const uint32_t i : places) elements.insert(elements.end(), array.row(rows[i]), array.row(rows[i]) + size);
    if (!places.empty())
      accessor["sparse"] = {{"count", places.size()},
                            {"indices",
                             {{"bufferView", builder.buffer_view(bytes_of(places))},
                              {"componentType", static_cast<int>(Component::u32)}}},
                            {"values", {{"bufferView", builder.buffer_view(elements)}}}};
  } else {
    const int view = builder.buffer_view(elements, array_buffer);
    document.json["bufferViews"][static_cast<size_t>(view)]["byteStride"] = size;
    accessor["bufferView"] = view;
  }
  if (array.semantic == "POSITION") state_bounds(accessor, elements, places.size() < rows.size());
  return builder.add("accessors", std::move(accessor));
}

DeformationAccessors Deformation::write(Document& document, std::span<const uint32_t> rows) const {
  DeformationAccessors accessors;
  for (const Array& array : attributes_) accessors.attributes[array.semantic] = write(document, array, rows);
  for (const auto& target : targets_) {
    accessors.targets.emplace_back();
    for (const Array& array : target) accessors.targets.back()[array.semantic] = write(document, array, rows);
  }
  return accessors;
}

Result<DeformationAccessors> prefix_of(const DeformationAccessors& accessors, size_t vertices, Document& document) {
  DeformationAccessors prefix = accessors;
  for (auto& [semantic, accessor] : prefix.attributes) {
    LW_TRY(index, append_prefix(document, accessor, vertices));
    accessor = index;
  }
  for (auto& target : prefix.targets)
    for (auto& [semantic, accessor] : target) {
      LW_TRY(index, append_prefix(document, accessor, vertices));
      accessor = index;
    }
  return prefix;
}

void bend_by(const DeformationAccessors& accessors, Json& primitive) {
  for (const auto& [semantic, accessor] : accessors.attributes) primitive["attributes"][semantic] = accessor;
  primitive.erase("targets");
  for (const auto& target : accessors.targets) primitive["targets"].push_back(target);
}

Result<void> verify_deformation(const Json& json, const Json& primitive, const DeformationAccessors& accessors,
                                uint32_t base_vertices, uint32_t vertices, const std::string& name) {
  if (member(primitive, "targets").size() != accessors.targets.size())
    return fail(name, "has not the morph targets that its stream refines");
  const Json& list = member(json, "accessors");
  return for_each(
      accessors, [&](const Json::json_pointer& place, const std::string& semantic, int index) -> Result<void> {
        const Json& all = element(list, static_cast<size_t>(index));
        const Json& said = primitive.contains(place) ? primitive[place] : Json();
        if (!said.is_number()) return fail(name, place.to_string().substr(1) + " is missing");
        const Json& base = element(list, static_cast<size_t>(whole_number(said)));
        const ElementType type = element_type(all);
        if (type.rows != (bends(semantic) ? 4 : 3) || type.columns != 1 ||
            whole_number(member(all, "count")) != vertices)
          return fail(name + "." + mesh_extension + ".deformation",
                      semantic + " is of a type or count that it cannot have");
        const auto same = [&](const char* key) { return member(base, key) == member(all, key); };
        const bool prefix = whole_number(member(base, "count")) == base_vertices && same("type") &&
                            same("componentType") && same("normalized") && same("bufferView") && same("byteOffset");
        const Json &few = member(base, "sparse"), &many = member(all, "sparse");
        const bool sparse_too = few.is_null() || (member(few, "indices") == member(many, "indices") &&
                                                  member(few, "values") == member(many, "values"));
        if (!prefix || !sparse_too)
          return fail(name, semantic + " is not the start of the array that its stream refines");
        return {};
      });
}

}  // namespace lightwell
