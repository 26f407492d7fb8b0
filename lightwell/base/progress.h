// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace lightwell {

/// A long computation's way to its user: it reports how far it is, and asks whether it shall go on. All functions may
/// be called from any thread, and from several at once.
class Progress {
 public:
  virtual ~Progress() = default;
  /// Begins a stage of `total` units ("photons", "collapses"); 0 when their number is unknown.
  virtual void stage(std::string_view /*name*/, double /*total*/, std::string_view /*unit*/) {}
  /// Reports that `done` units of the stage are done. Threads may report out of order; the largest number holds.
  virtual void advance(double /*done*/) {}
  /// True when the user wants the computation to end; it then fails as soon as it can, with ErrorKind::cancelled. Once
  /// true, it stays true.
  virtual bool cancelled() const { return false; }
};

}  // namespace lightwell
