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

/// The output of a command: figures go to stdout, everything else to stderr. Its members are options of every command.
struct Console {
  bool json = false;   ///< print one JSON object instead of lines
  bool quiet = false;  ///< no progress, no warnings

  /// Prints one line on stderr, "lightwell: FILE: ELEMENT: REASON", and returns the exit status for bad input. For
  /// ErrorKind::cancelled the line says that nothing was written, and the status is 128 plus the signal's number, as in
  /// a shell: 130 for Ctrl-C, 143 for SIGTERM.
  int fail(const Error& error) const;
  void warn(const std::string& warning) const;
  void warn(const Report& report) const;
  /// Prints the figures of a command: as JSON, or formatted by figures_text().
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
  /// A line of its own after this stage's. Not printed after a failure, of which only the error is shown.
  void note(const std::string& line) { note_ = line; }
  /// Ends the last stage and prints its time. Not called after a failure, of which only the error is shown.
  void finish();

 private:
  void draw(double done, double seconds);
  void erase() const;

  std::mutex mutex_;
  bool enabled_;
  bool terminal_;
  std::string name_;
  std::string unit_;
  std::string note_;
  double total_ = 0;
  double done_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point drawn_;
};

/// Calls `work` with a Progress that is shown, and returns its Result.
template <typename Work>
auto with_progress(const Console& console, const Work& work) {
  ConsoleProgress progress(console);
  auto outcome = work(progress);
  if (outcome) progress.finish();
  return outcome;
}

/// A clock whose lap() gives the seconds since it was made or last read.
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
