// SPDX-License-Identifier: Apache-2.0
// The arm with what it holds: the selected tool and a job's load, and the masses and places that result.

#pragma once

#include <utility>

#include "control/robot/files/program.h"
#include "control/robot/group/parts.h"
#include "control/robot/kinematics/tool_set.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

class HeldTool {
 public:
  // `parts` must outlive it.
  explicit HeldTool(const GroupParts& parts)
      : book_(parts.book),
        tools_(parts.arm, parts.book.tips()),
        dynamics_(parts.dynamics),
        places_(tools_.arm(0), tools_.inverse(0), Workspace::of(parts.settings.workspace), parts.clearance) {
    weigh();
    places_.weigh(dynamics_.limited() ? &dynamics_ : nullptr);
  }
  HeldTool(const HeldTool&) = delete;
  HeldTool& operator=(const HeldTool&) = delete;

  // Calls add(object) for all that pointers to arms lead to, see KeptImage.
  template <class Add>
  void blocks(const Add& add) const {
    tools_.blocks(add);
  }
  [[nodiscard]] int number() const noexcept { return tool_; }
  [[nodiscard]] const Tool& tool() const noexcept { return book_.tools[at(tool_)]; }
  // Number of times that a tool was selected: then the tip is elsewhere, although the arm did not move.
  [[nodiscard]] unsigned changes() const noexcept { return changes_; }
  // The arm up to the tool's tip, and up to its own end.
  [[nodiscard]] const Arm& arm() const noexcept { return places_.arm(); }
  [[nodiscard]] const Arm& bare_arm() const noexcept { return tools_.arm(0); }
  [[nodiscard]] const Places& places() const noexcept { return places_; }
  [[nodiscard]] const Inverse& inverse() const noexcept { return places_.inverse(); }
  // The masses of the arm, the tool and the load.
  [[nodiscard]] const Dynamics& dynamics() const noexcept { return dynamics_; }

  // The following functions are called only while nothing is planned or followed. They are real-time safe.
  void select(int tool) noexcept {
    tool_ = tool;
    ++changes_;
    places_.take(tools_.arm(tool), tools_.inverse(tool), tool);
    weigh();
  }
  void select_load(int load) noexcept {
    load_ = book_.loads[at(load)];
    weigh();
  }
  // Exchanges tools and bodies with a program whose book has been taken over; `tool`: the held one in it.
  void replace(Program& program, int tool) noexcept {
    std::swap(tools_, program.tools);
    places_.swap(program.clearance);
    select(tool);
  }

 private:
  void weigh() noexcept { dynamics_.hold(joined(tool().body, load_)); }

  const JobBook& book_;
  ToolSet tools_;
  Dynamics dynamics_;
  Places places_;
  int tool_ = 0;
  unsigned changes_ = 0;
  Body load_;  // of a job, in addition to the tool
};

}  // namespace indurop::robot
