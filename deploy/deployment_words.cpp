// SPDX-License-Identifier: Apache-2.0
#include "deploy/deployment_words.h"

namespace indurop::deploy {

const char* to_text(Phase phase) noexcept {
  switch (phase) {
    case Phase::Steady:
      return "steady";
    case Phase::Fetching:
      return "fetching";
    case Phase::Checking:
      return "checking";
    case Phase::Prepared:
      return "prepared";
    case Phase::Trial:
      return "trial";
    case Phase::Healthy:
      return "healthy";
    case Phase::Failed:
      return "failed";
  }
  return "?";
}

const char* to_text(NodeCondition condition) noexcept {
  switch (condition) {
    case NodeCondition::None:
      return "empty";
    case NodeCondition::Starting:
      return "starting";
    case NodeCondition::Running:
      return "running";
    case NodeCondition::Stopping:
      return "stopping";
    case NodeCondition::Restarting:
      return "restarting";
    case NodeCondition::Failed:
      return "failed";
  }
  return "?";
}

}  // namespace indurop::deploy
