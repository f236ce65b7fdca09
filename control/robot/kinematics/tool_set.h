// SPDX-License-Identifier: Apache-2.0
// The arm with each of its tools: each tool has an arm that ends at its tip. Tool 0 is no tool.

#pragma once

#include <memory>
#include <vector>

#include "control/robot/kinematics/inverse.h"

namespace indurop::robot {

class ToolSet {
 public:
  // `tools`: the tips, seen from the arm's end; at least one. Allocates; no other function of this class does.
  ToolSet(const Arm& arm, const std::vector<Pose>& tools);

  // Calls add(object) for all that pointers to arms lead to, see KeptImage.
  template <class Add>
  void blocks(const Add& add) const {
    for (const auto& one : held_) {
      add(*one);
    }
  }
  [[nodiscard]] int count() const noexcept { return static_cast<int>(held_.size()); }
  [[nodiscard]] const Arm& arm(int tool) const noexcept { return held_[static_cast<std::size_t>(tool)]->arm; }
  [[nodiscard]] const Inverse& inverse(int tool) const noexcept {
    return held_[static_cast<std::size_t>(tool)]->inverse;
  }

 private:
  struct Held {
    explicit Held(const Arm& with_tool) : arm(with_tool), inverse(arm) {}
    Arm arm;
    Inverse inverse;  // refers to `arm`, so neither may move
  };
  std::vector<std::unique_ptr<const Held>> held_;
};

}  // namespace indurop::robot
