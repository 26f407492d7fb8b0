// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lightwell {

/// The figures of `lightwell info` as text for people: a line for each mesh, grid, lamp and stream, with units.
std::string info_text(const nlohmann::ordered_json& figures);

}  // namespace lightwell
