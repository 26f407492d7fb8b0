// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace lightwell {

/// Lets a long computation report its progress and learn that it was cancelled. advance() and cancelled() may be called
/// from any thread, and from several at once; stage() only from the thread that began the computation.
class Progress {
 public:
  virtual ~Progress() = default;
  /// Begins a stage of `total` units, such as "photons", whose rate is shown; 0 if their number is unknown, no unit if
  /// their rate tells nothing.
  virtual void stage(std::string_view /*name*/, double /*total*/, std::string_view /*unit*/) {}
  /// Reports that `done` units of the stage are done. Threads may report out of order; the largest number counts.
  virtual void advance(double /*done*/) {}
  /// True when the user has cancelled the computation, which then fails with ErrorKind::cancelled as soon as it can.
  /// Once true, it stays true.
  virtual bool cancelled() const { return false; }
};

}  // namespace lightwell
