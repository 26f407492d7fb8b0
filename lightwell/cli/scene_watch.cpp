// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/scene_watch.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <optional>

#include "lightwell/scene/scene_files.h"

namespace lightwell {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds glance(100);  // between two looks at files and processes
constexpr std::chrono::milliseconds rest(300);    // of files that are written completely
constexpr int failed_status = 1;

void pause_for(std::chrono::milliseconds time) { std::this_thread::sleep_for(time); }

/// Starts this program with the given arguments, its stdout closed off; nothing when the system cannot.
std::optional<pid_t> start(std::vector<std::string> arguments) {
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int error = ::posix_spawn(&process, "/proc/self/exe", &files, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  return error == 0 ? std::optional(process) : std::nullopt;
}

/// Waits for a process, which is told to end when `enough` says so, and returns its exit status as a shell does.
int wait_for(pid_t process, const std::function<bool()>& enough) {
  int status = 0;
  for (bool told = false; ::waitpid(process, &status, WNOHANG) == 0; pause_for(glance)) {
    if (told || !enough()) continue;
    ::kill(process, SIGTERM);
    told = true;
  }
  constexpr int signalled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : signalled + WTERMSIG(status);
}

}  // namespace

Result<SceneWatch> SceneWatch::make(Options options, std::function<bool()> ended) {
  std::error_code code;
  std::string folder = (fs::temp_directory_path(code) / "lightwell-XXXXXX").string();
  if (code || ::mkdtemp(folder.data()) == nullptr) return fail(ErrorKind::io, folder, "cannot be made");
  fs::path pack = fs::path(folder) / options.scene.stem();
  pack += ".lw.glb";
  return SceneWatch(std::move(options), std::move(ended), std::move(pack));
}

SceneWatch::SceneWatch(Options options, std::function<bool()> ended, fs::path pack)
    : options_(std::move(options)), ended_(std::move(ended)), pack_(std::move(pack)) {}

SceneWatch::SceneWatch(SceneWatch&& other) noexcept = default;

SceneWatch::~SceneWatch() {
  if (thread_.joinable()) thread_.join();
  std::error_code ignored;
  if (!pack_.empty()) fs::remove_all(pack_.parent_path(), ignored);
}

void SceneWatch::look_at_files() {
  files_ = files_of_scene(options_.scene);
  // Such as the picture of --environment.
  files_.insert(files_.end(), options_.bake.begin(), options_.bake.end());
  seen_ = state();
}

SceneWatch::State SceneWatch::state() const {
  State state;
  for (const fs::path& file : files_) {
    std::error_code missing;
    const fs::file_time_type time = fs::last_write_time(file, missing);
    state.emplace_back(missing ? fs::file_time_type::min() : time, missing ? 0 : fs::file_size(file, missing));
  }
  return state;
}

int SceneWatch::bake() {
  for (;;) {
    const int status = bake_once();
    if (ended_() || !has_changed()) return status;
    wait_for_rest();
  }
}

int SceneWatch::bake_once() {
  look_at_files();
  std::vector<std::string> arguments = {"lightwell", "bake", options_.scene.string(), "-o", pack_.string()};
  if (options_.quiet) arguments.emplace_back("--quiet");
  arguments.insert(arguments.end(), options_.bake.begin(), options_.bake.end());
  const auto process = start(std::move(arguments));
  return process ? wait_for(*process, [this] { return ended_() || has_changed(); }) : failed_status;
}

/// Waits until nobody writes to the files, and the scene is there: some programs remove a file before they write it.
void SceneWatch::wait_for_rest() const {
  State before;
  std::error_code unknown;
  for (State now = state(); !ended_() && (now != before || !fs::exists(options_.scene, unknown)); now = state()) {
    before = std::move(now);
    pause_for(rest);
  }
}

void SceneWatch::begin() {
  thread_ = std::thread([this] {
    for (; !ended_(); pause_for(glance)) {
      if (!has_changed()) continue;
      wait_for_rest();
      if (!ended_()) bake();
    }
  });
}

}  // namespace lightwell
