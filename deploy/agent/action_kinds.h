// SPDX-License-Identifier: Apache-2.0
// Kinds of commands to a board, by what executes them.

#pragma once

#include "deploy/words/command_words.h"
#include "scheduler/module_command.h"

namespace indurop::deploy {

inline scheduler::ModuleCommand module_command_of(Action action) noexcept {
  return action == Action::StopModule    ? scheduler::ModuleCommand::Stop
         : action == Action::StartModule ? scheduler::ModuleCommand::Start
                                         : scheduler::ModuleCommand::Restart;
}

inline bool is_write(Action action) noexcept {
  return action == Action::Force || action == Action::Unforce || action == Action::Set || action == Action::SetLock;
}

inline bool is_about_node(Action action) noexcept {
  return action == Action::StopNode || action == Action::StartNode || action == Action::RestartNode;
}

// A stop is carried out even if it cannot be logged: a full disk must not keep anybody from stopping what moves (IEC
// 62443-3-3, SR 2.10).
inline bool is_stop(Action action) noexcept {
  return action == Action::StopModule || action == Action::StopNode;
}

inline bool is_about_alarms(Action action) noexcept {
  return action == Action::AckAlarms || action == Action::ShelveAlarms || action == Action::UnshelveAlarms;
}

inline bool is_recording(Action action) noexcept {
  return action == Action::Record || action == Action::EndRecord || action == Action::DropRecord;
}

}  // namespace indurop::deploy
