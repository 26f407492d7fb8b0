// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lightwell {

/// The figures of a command as text for people: a line each, "peak memory: 17.2 MB", the members of an object side by
/// side on its line. The key of a figure determines its unit (seconds, bytes or percent).
std::string figures_text(const nlohmann::ordered_json& figures);

}  // namespace lightwell
