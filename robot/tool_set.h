// SPDX-License-Identifier: Apache-2.0
// The arm with each of its tools: what a tool's tip does is asked of an arm that ends there. Tool 0 is none.

#pragma once

#include <memory>
#include <vector>

#include "robot/inverse.h"

namespace indurop::robot {

class ToolSet {
 public:
  // `tools`: where each tip is, seen from the arm's end; at least one. Allocates; nothing else here does.
  ToolSet(const Arm& arm, const std::vector<Pose>& tools);

  [[nodiscard]] int count() const noexcept { return static_cast<int>(held_.size()); }
  [[nodiscard]] const Arm& arm(int tool) const noexcept { return held_[static_cast<std::size_t>(tool)]->arm; }
  [[nodiscard]] const Inverse& inverse(int tool) const noexcept {
    return held_[static_cast<std::size_t>(tool)]->inverse;
  }

 private:
  struct Held {
    explicit Held(const Arm& with_tool) : arm(with_tool), inverse(arm) {}
    Arm arm;
    Inverse inverse;  // of that arm, so neither moves
  };
  std::vector<std::unique_ptr<const Held>> held_;
};

}  // namespace indurop::robot
