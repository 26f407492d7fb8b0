// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lightwell/gltf/document.h"
#include "lightwell/gltf/references.h"

namespace lightwell {
namespace {

/// The new index of each element of an array, -1 for those that nothing refers to.
std::vector<int> used_elements(const Json& json, std::string_view array) {
  std::vector<int> numbers(referenced_array(json, array).size(), -1);
  for_each_reference(json, array, [&](const Json& value, std::string_view, const ReferencePlace&) {
    const int64_t index = whole_number(value);
    if (index >= 0 && static_cast<size_t>(index) < numbers.size()) numbers[static_cast<size_t>(index)] = 0;
  });
  int next = 0;
  for (int& number : numbers)
    if (number == 0) number = next++;
  return numbers;
}

template <typename Elements>
void keep_numbered(Elements& elements, const std::vector<int>& numbers) {
  for (size_t i = 0; i < numbers.size(); i++)
    if (numbers[i] >= 0 && static_cast<size_t>(numbers[i]) != i)
      elements[static_cast<size_t>(numbers[i])] = std::move(elements[i]);
  const auto kept = std::count_if(numbers.begin(), numbers.end(), [](int number) { return number >= 0; });
  elements.erase(elements.begin() + kept, elements.end());
}

/// Removes the unused elements of a top-level array and returns the new index of each, -1 for the removed ones.
std::vector<int> drop_unused_elements(Json& json, const char* array) {
  std::vector<int> numbers = used_elements(json, array);
  if (std::find(numbers.begin(), numbers.end(), -1) == numbers.end()) return numbers;
  for_each_reference(json, array, [&](Json& value, std::string_view, const ReferencePlace&) {
    const int64_t index = whole_number(value);
    if (index >= 0 && static_cast<size_t>(index) < numbers.size()) value = numbers[static_cast<size_t>(index)];
  });
  keep_numbered(json[array], numbers);
  if (json[array].empty()) json.erase(array);
  return numbers;
}

}  // namespace

void drop_unused(Document& document) {
  drop_unused_elements(document.json, "accessors");
  drop_unused_elements(document.json, "bufferViews");
  const std::vector<int> buffers = drop_unused_elements(document.json, "buffers");
  if (buffers.size() == document.buffers.size()) keep_numbered(document.buffers, buffers);
}

void drop_unused_images(Document& document) { drop_unused_elements(document.json, "images"); }

}  // namespace lightwell
