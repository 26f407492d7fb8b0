// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>

#include "lightwell/bake/node_surroundings.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// Keeps the light of nodes in a file as it is gathered, so that a bake that was interrupted can be continued: what the
/// file holds need not be gathered again. Threads may share it.
class NodeJournal {
 public:
  /// Opens a file, or makes it, and reads what is whole in it: it may end anywhere, and what is damaged is forgotten.
  /// Fails when it cannot be read or written.
  static Result<std::unique_ptr<NodeJournal>> open(const std::filesystem::path& path);

  /// A number that tells apart what a node's light depends on; `inputs` stands for the scene and the options.
  static uint64_t key(uint64_t inputs, const Vec3f& node, const Vec3f& cell);

  /// What is known of a node.
  std::optional<NodeSurroundings> find(uint64_t key) const;
  /// Keeps what was found. When the file cannot take it, it is known in this run only.
  void add(uint64_t key, const NodeSurroundings& found);

  size_t size() const;

 private:
  NodeJournal() = default;

  mutable std::mutex mutex_;
  std::unordered_map<uint64_t, NodeSurroundings> known_;
  std::ofstream file_;
  size_t unwritten_ = 0;  // records since the file was flushed
};

}  // namespace lightwell
