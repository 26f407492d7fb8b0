// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/console.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

namespace lightwell {
namespace {

volatile std::sig_atomic_t interrupted = 0;  // the signal that did

void note_interrupt(int signal) {
  interrupted = signal;
  std::signal(signal, SIG_DFL);  // a second Ctrl-C ends at once
}

// "8.00 M", "25.3 k", "512"
std::string short_number(double value) {
  char text[32];
  if (value >= 1e6)
    std::snprintf(text, sizeof text, "%.2f M", value / 1e6);
  else if (value >= 1e4)
    std::snprintf(text, sizeof text, "%.1f k", value / 1e3);
  else
    std::snprintf(text, sizeof text, "%.0f", value);
  return text;
}

// The name of an entry of the object that is called `key`; the outermost one has no name.
std::string entry_name(const std::string& key, const std::string& name) {
  return key.empty() ? name : key + "." + name;
}

void print_lines(const nlohmann::ordered_json& value, const std::string& key) {
  if (value.is_object()) {
    for (const auto& [name, item] : value.items()) print_lines(item, entry_name(key, name));
    return;
  }
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  std::printf("%s: %s\n", key.c_str(), text.c_str());
}

}  // namespace

int Console::fail(const Error& error) const {
  if (interrupted != 0) {
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
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;  // names of a file may not be UTF-8
  if (json) {
    std::printf("%s\n", figures.dump(-1, ' ', false, replace).c_str());
  } else {
    print_lines(figures, "");
  }
}

ConsoleProgress::ConsoleProgress(const Console& console)
    : enabled_(!console.quiet), terminal_(isatty(STDERR_FILENO) != 0) {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
}

ConsoleProgress::~ConsoleProgress() {
  end_stage();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool ConsoleProgress::cancelled() const { return interrupted != 0; }

void ConsoleProgress::stage(std::string_view name, double total, std::string_view unit) {
  end_stage();
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
      line += ", " + short_number(done / seconds) + " " + unit_ + "/s";
      line += ", " + short_number(seconds / done * (total_ - done)) + " s left";
    }
  }
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

void ConsoleProgress::end_stage() {
  const std::lock_guard lock(mutex_);
  if (name_.empty() || !enabled_) return;
  if (terminal_) std::fputs("\r\033[K", stderr);
  if (cancelled()) return name_.clear();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::fprintf(stderr, "%s: %.1f s", name_.c_str(), seconds);
  if (total_ > 0 && seconds > 0)
    std::fprintf(stderr, ", %s %s/s", short_number(total_ / seconds).c_str(), unit_.c_str());
  std::fputc('\n', stderr);
  name_.clear();
}

uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace lightwell
