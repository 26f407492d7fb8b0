// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "lightwell/base/progress.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// How a command talks: figures go to stdout, everything else to stderr. Options that every command has.
struct Console {
  bool json = false;   ///< print one JSON object instead of lines
  bool quiet = false;  ///< no progress, no warnings

  /// One line on stderr, "lightwell: FILE: ELEMENT: REASON"; returns the exit status for bad input. When Ctrl-C or
  /// SIGTERM has ended the work the line says that instead, and the status is the shell's for that signal: 130 or 143.
  int fail(const Error& error) const;
  void warn(const std::string& warning) const;
  void warn(const Report& report) const;
  /// Prints the figures of a command: as JSON, or as figures_text() has them.
  void print(const nlohmann::ordered_json& figures) const;
};

/// Progress on stderr: on a terminal one line that is redrawn (bar, rate, time left), otherwise one line a stage.
/// Ctrl-C (SIGINT) and SIGTERM make cancelled() true, so that the computation ends and nothing half-written is left.
class ConsoleProgress : public Progress {
 public:
  explicit ConsoleProgress(const Console& console);
  ~ConsoleProgress() override;

  void stage(std::string_view name, double total, std::string_view unit) override;
  void advance(double done) override;
  bool cancelled() const override;
  /// Ends the last stage; one that failed is never ended, and the error is all that is said of it.
  void finish();

 private:
  void draw(double done, double seconds);
  void erase() const;

  std::mutex mutex_;
  bool enabled_;
  bool terminal_;
  std::string name_;
  std::string unit_;
  double total_ = 0;
  double done_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point drawn_;
};

/// Does `work`, a function of a Progress with a Result, and tells of its progress.
template <typename Work>
auto with_progress(const Console& console, const Work& work) {
  ConsoleProgress progress(console);
  auto outcome = work(progress);
  if (outcome) progress.finish();
  return outcome;
}

/// Seconds since it was made or last read by lap().
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The largest resident memory of this process so far, in bytes.
uint64_t peak_memory();

}  // namespace lightwell
