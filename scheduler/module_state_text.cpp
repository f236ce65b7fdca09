// SPDX-License-Identifier: Apache-2.0
#include "scheduler/module_state_text.h"

namespace indurop::scheduler {

const char* down_text(ModuleState state) noexcept {
  switch (state) {
    case ModuleState::Loaded:
    case ModuleState::Starting:
      return "has not started yet";
    case ModuleState::Stopped:
      return "is stopped";
    case ModuleState::Faulted:
      return "is out of service";
    case ModuleState::Restarting:
      return "is waiting for its restart";
    case ModuleState::Running:
    case ModuleState::Exited:
      break;
  }
  return nullptr;
}

}  // namespace indurop::scheduler
