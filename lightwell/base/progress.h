// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace lightwell {

/// Whom a long computation tells how far it is, and who may ask it to stop. Calls may come from any thread.
class Progress {
 public:
  virtual ~Progress() = default;
  /// A new stage begins; it will count `total` of `unit` ("photons", "collapses"), 0 when that is unknown.
  virtual void stage(std::string_view /*name*/, double /*total*/, std::string_view /*unit*/) {}
  /// `done` of the stage's total are done.
  virtual void advance(double /*done*/) {}
  /// True when the user wants the computation to end; it then returns an error as soon as it can.
  virtual bool cancelled() const { return false; }
};

}  // namespace lightwell
