// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "lightwell/base/result.h"

namespace lightwell {

/// Bakes a scene into a pack of its own, and again whenever a file of the scene has changed. Each bake is a process of
/// this program, which says on stderr what it does and what is wrong; the pack is replaced when a bake has succeeded.
class SceneWatch {
 public:
  struct Options {
    std::filesystem::path scene;
    std::vector<std::string> bake;  ///< options of the bakes
    bool quiet = false;
  };

  /// Makes the folder of the pack, which goes when the watch does. `ended` tells that nothing is to be baked any more;
  /// a bake under way is then cancelled.
  static Result<SceneWatch> make(Options options, std::function<bool()> ended);
  SceneWatch(SceneWatch&& other) noexcept;
  ~SceneWatch();

  const std::filesystem::path& pack() const { return pack_; }
  /// Bakes, anew if files change meanwhile, and returns the exit status of the last bake.
  int bake();
  /// Bakes after each change, from now on, until it has ended.
  void begin();

 private:
  /// When files were changed last, and how long they are.
  using State = std::vector<std::pair<std::filesystem::file_time_type, uintmax_t>>;

  SceneWatch(Options options, std::function<bool()> ended, std::filesystem::path pack);
  int bake_once();
  void look_at_files();
  State state() const;
  bool has_changed() const { return state() != seen_; }
  void wait_for_rest() const;

  Options options_;
  std::function<bool()> ended_;
  std::filesystem::path pack_;
  std::vector<std::filesystem::path> files_;
  State seen_;
  std::thread thread_;
};

}  // namespace lightwell
