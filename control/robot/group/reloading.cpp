// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/reloading.h"

#include <algorithm>
#include <utility>

namespace indurop::robot {

bool Reloading::possible(bool resting) const noexcept {
  return resting && robot_.states.resting() && !robot_.axes.any_busy() && group_.settled() &&
         !robot_.job.pulses().any();
}

void Reloading::step(bool wanted, bool resting, Signals& signals) noexcept {
  if (wanted && !reading_ && !possible(resting)) {
    group_.finish_service(ErrorCode::State);
  } else if (wanted && !reading_ && loader_.free()) {
    loader_.ask(signals, robot_.parts.book.signals);
    reading_ = used_ = true;
  }
  if (!reading_ || !loader_.made() || (wanted && possible(resting) && plans_.holds_forgotten())) {
    return;
  }
  reading_ = false;
  take_result(wanted, possible(resting), signals);
  loader_.give_back();
}

void Reloading::take_result(bool wanted, bool possible, Signals& signals) noexcept {
  if (loader_.crash()[0] != '\0') {
    group_.break_down("the thread that reads jobs", loader_.crash());
  } else if (wanted && loader_.program() == nullptr) {
    robot_.job.set_message(loader_.why());
    group_.finish_service(ErrorCode::Line);
  } else if (wanted && !possible) {
    group_.finish_service(ErrorCode::State);
  } else if (wanted) {
    group_.finish_service(take_program(*loader_.program(), signals));
  }
}

// Replaces the robot's program; the old one is left in `program`, for the thread to destroy.
ErrorCode Reloading::take_program(Program& program, Signals& signals) noexcept {
  const std::vector<Tool>& tools = program.book.tools;
  const std::string& held = robot_.tool.tool().name;
  const auto same = std::find_if(tools.begin(), tools.end(), [&](const Tool& tool) { return tool.name == held; });
  if (same == tools.end()) {
    robot_.job.set_message("the tool that is held is not in the files any more; lay it down first (SVC_AD_TOOL 0)");
    return ErrorCode::Tool;
  }
  const auto tool = static_cast<int>(same - tools.begin());
  group_.drop_aside();
  robot_.job.forget();
  std::swap(robot_.parts.book, program.book);
  robot_.tool.replace(program, tool);
  torques_.reweigh();
  plans_.desk().planner().clear_way().swap(program.planned);
  robot_.follower.clear_way().swap(program.followed);
  clear_.replace(program);
  robot_.follower.reset(robot_.commanded());
  if (loader_.other_signals()) {
    signals.adopt();
  }
  return ErrorCode::Ok;
}

}  // namespace indurop::robot
