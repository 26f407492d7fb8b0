// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/console.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "lightwell/cli/figures_text.h"

namespace lightwell {
namespace {

volatile std::sig_atomic_t interrupted = 0;  // the number of the signal

void note_interrupt(int signal) {
  interrupted = signal;
  std::signal(signal, SIG_DFL);  // a second Ctrl-C ends at once
}

// "8.00 M", "25.3 k", "512"
std::string scaled_number(double value) {
  char text[32];
  if (value >= 1e6)
    std::snprintf(text, sizeof text, "%.2f M", value / 1e6);
  else if (value >= 1e4)
    std::snprintf(text, sizeof text, "%.1f k", value / 1e3);
  else
    std::snprintf(text, sizeof text, "%.0f", value);
  return text;
}

}  // namespace

int Console::fail(const Error& error) const {
  if (error.kind == ErrorKind::cancelled) {
    std::fputs("lightwell: cancelled, nothing written\n", stderr);
    return 128 + interrupted;
  }
  std::fprintf(stderr, "lightwell: %s\n", error.message().c_str());
  return 1;
}

void Console::warn(const std::string& warning) const {
  if (!quiet) std::fprintf(stderr, "lightwell: warning: %s\n", warning.c_str());
}

void Console::warn(const Report& report) const {
  for (const std::string& warning : report.warnings) warn(warning);
}

void Console::print(const nlohmann::ordered_json& figures) const {
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;  // names from a file need not be UTF-8
  const std::string text = json ? figures.dump(-1, ' ', false, replace) + "\n" : figures_text(figures);
  std::fputs(text.c_str(), stdout);
}

ConsoleProgress::ConsoleProgress(const Console& console)
    : enabled_(!console.quiet), terminal_(isatty(STDERR_FILENO) != 0) {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
}

ConsoleProgress::~ConsoleProgress() {
  erase();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool ConsoleProgress::cancelled() const { return interrupted != 0; }

void ConsoleProgress::stage(std::string_view name, double total, std::string_view unit) {
  finish();
  const std::lock_guard lock(mutex_);
  name_ = name;
  unit_ = unit;
  total_ = total;
  done_ = 0;
  start_ = drawn_ = std::chrono::steady_clock::now();
  if (enabled_ && terminal_) draw(0, 0);
}

void ConsoleProgress::advance(double done) {
  const std::lock_guard lock(mutex_);
  done_ = std::max(done_, done);
  const auto now = std::chrono::steady_clock::now();
  if (!enabled_ || !terminal_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  draw(done_, std::chrono::duration<double>(now - start_).count());
}

void ConsoleProgress::draw(double done, double seconds) {
  std::string line = "\r\033[K" + name_;
  if (total_ > 0) {
    constexpr int width = 30;
    const double share = std::clamp(done / total_, 0.0, 1.0);
    const auto filled = static_cast<size_t>(share * width);
    line += " [" + std::string(filled, '#') + std::string(width - filled, '.') + "] ";
    line += std::to_string(static_cast<int>(share * 100)) + " %";
    if (seconds > 0.5 && done > 0) {
      if (!unit_.empty()) line += ", " + scaled_number(done / seconds) + " " + unit_ + "/s";
      line += ", " + scaled_number(seconds / done * (total_ - done)) + " s left";
    }
  }
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

void ConsoleProgress::erase() const {
  if (enabled_ && terminal_ && !name_.empty()) std::fputs("\r\033[K", stderr);
}

void ConsoleProgress::finish() {
  const std::lock_guard lock(mutex_);
  if (name_.empty() || !enabled_) return;
  erase();
  if (cancelled()) return name_.clear();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::fprintf(stderr, "%s: %.1f s", name_.c_str(), seconds);
  if (total_ > 0 && seconds > 0 && !unit_.empty())
    std::fprintf(stderr, ", %s %s/s", scaled_number(total_ / seconds).c_str(), unit_.c_str());
  std::fputc('\n', stderr);
  name_.clear();
  if (!note_.empty()) std::fprintf(stderr, "%s\n", note_.c_str());
  note_.clear();
}

uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace lightwell
