// SPDX-License-Identifier: Apache-2.0
#include "scheduler/words.h"

namespace indurop::scheduler {

const char* to_text(NodeState state) noexcept {
  switch (state) {
    case NodeState::Starting:
      return "starting";
    case NodeState::Running:
      return "running";
    case NodeState::Stopping:
      return "stopping";
    case NodeState::Stopped:
      return "stopped";
    case NodeState::Failed:
      return "failed";
  }
  return "unknown";
}

const char* to_text(ModuleState state) noexcept {
  switch (state) {
    case ModuleState::Loaded:
      return "loaded";
    case ModuleState::Starting:
      return "starting";
    case ModuleState::Running:
      return "running";
    case ModuleState::Stopped:
      return "stopped";
    case ModuleState::Faulted:
      return "faulted";
    case ModuleState::Restarting:
      return "restarting";
    case ModuleState::Exited:
      return "exited";
  }
  return "unknown";
}

const char* to_text(ModuleType type) noexcept {
  switch (type) {
    case ModuleType::Thread:
      return "thread";
    case ModuleType::Process:
      return "process";
  }
  return "unknown";
}

const char* to_text(Operation operation) noexcept {
  switch (operation) {
    case Operation::Periodic:
      return "periodic";
    case Operation::Sporadic:
      return "sporadic";
    case Operation::NonReal:
      return "non-real";
  }
  return "unknown";
}

const char* to_text(FaultKind kind) noexcept {
  switch (kind) {
    case FaultKind::None:
      return "none";
    case FaultKind::Exception:
      return "exception";
    case FaultKind::Signal:
      return "signal";
    case FaultKind::Budget:
      return "budget";
    case FaultKind::Overrun:
      return "overrun";
    case FaultKind::Exit:
      return "exit";
    case FaultKind::StartFailed:
      return "start-failed";
  }
  return "unknown";
}

}  // namespace indurop::scheduler
