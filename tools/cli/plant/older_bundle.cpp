// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/older_bundle.h"

#include <algorithm>

namespace indurop::tools {

std::optional<OlderBundle> older_bundle(const std::vector<PastDeployment>& history, const std::string& current,
                                        const std::string& id) {
  const auto first_commit = [&](const std::string& deployment) {
    return std::find_if(history.begin(), history.end(), [&](const PastDeployment& past) {
      return past.deployment == deployment && past.outcome == "committed";
    });
  };
  const auto bundle = first_commit(id);
  const auto running = first_commit(current);
  if (running == history.end() || bundle >= running || bundle->plant != running->plant) {
    return std::nullopt;
  }
  return OlderBundle{*bundle, *running};
}

}  // namespace indurop::tools
