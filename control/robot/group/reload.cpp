// SPDX-License-Identifier: Apache-2.0
// Reloads jobs, points, tools, frames and zones from their files while the robot is at standstill.

#include <algorithm>
#include <utility>

#include "control/robot/group/group.h"

namespace indurop::robot {

bool Group::may_reload() const noexcept {
  const bool stands = state_ == GroupState::Standby || state_ == GroupState::Disabled;
  const bool busy = std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.busy(); });
  return stands && !enabling_ && !busy && settled() && motion_count_ == 0 && !job_.pulses();
}

// Called once per period. The result is used only if the service still waits for it, and nothing moves.
void Group::run_reload(Signals& signals) noexcept {
  const bool wanted = active_ && service_ == Service::JobReload;
  if (wanted && !reloading_ && !may_reload()) {
    finish_service(ErrorCode::State);
  } else if (wanted && !reloading_ && loader_.free()) {
    loader_.ask(signals, parts_.book.signals);
    reloading_ = true;
  }
  if (!reloading_ || !loader_.made() || (wanted && may_reload() && desk_.holds_forgotten())) {
    return;
  }
  reloading_ = false;
  if (loader_.crash()[0] != '\0') {
    break_down("the thread that reads jobs", loader_.crash());
  } else if (wanted && loader_.program() == nullptr) {
    job_.say(loader_.why());
    finish_service(ErrorCode::Line);
  } else if (wanted && !may_reload()) {
    finish_service(ErrorCode::State);
  } else if (wanted) {
    finish_service(take_program(*loader_.program(), signals));
  }
  loader_.give_back();
}

// Replaces the robot's program; the old one is left in `program`, for the thread to destroy.
ErrorCode Group::take_program(Program& program, Signals& signals) noexcept {
  const std::vector<Tool>& tools = program.book.tools;
  const std::string& held = parts_.book.tools[at(tool_)].name;
  const auto same = std::find_if(tools.begin(), tools.end(), [&](const Tool& tool) { return tool.name == held; });
  if (same == tools.end()) {
    job_.say("the tool that is held is not in the files any more; lay it down first (SVC_AD_TOOL 0)");
    return ErrorCode::Tool;
  }
  const auto tool = static_cast<int>(same - tools.begin());
  drop_aside();
  job_.forget();
  std::swap(parts_.book, program.book);
  std::swap(tools_, program.tools);
  places_.swap(program.clearance);
  desk_.planner().clear_way().swap(program.planned);
  follower_.clear_way().swap(program.followed);
  clear_.swap(program.unplanned);
  to_rest_.swap(program.to_rest);
  tool_ = tool;
  places_.take(tools_.arm(tool_), tools_.inverse(tool_), tool_);
  weigh();
  last_pose_ = places_.arm().forward(last_command_);
  follower_.reset(commanded());
  looks_ahead_ = false;
  if (loader_.other_signals()) {
    signals.adopt();
  }
  return ErrorCode::Ok;
}

}  // namespace indurop::robot
