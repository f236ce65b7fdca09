// SPDX-License-Identifier: Apache-2.0
#include "tools/plant/board_history.h"

#include "base/json.h"
#include "deploy/words/deployment_words.h"
#include "tools/plant/board_texts.h"

namespace indurop::tools {

std::vector<PastDeployment> fetch_history(deploy::DeployLink& link, std::uint64_t self, std::uint64_t agent) {
  const auto texts = fetch_texts(link, self, deploy::kHistoryBlob, {agent});
  const auto text = texts.find(agent);
  const base::Json whole = base::Json::parse(text == texts.end() ? "" : text->second).value_or(base::Json());
  std::vector<PastDeployment> history;
  for (const base::Json& entry : whole["history"].values()) {
    PastDeployment& past = history.emplace_back();
    if (!read(entry, "deployment", past.deployment) || !read(entry, "plant", past.plant) ||
        !read(entry, "generation", past.generation) || !read(entry, "host", past.host) ||
        !read(entry, "wall_ns", past.wall_ns) || !read(entry, "outcome", past.outcome)) {
      return {};  // not what an agent of this version says
    }
  }
  return history;
}

}  // namespace indurop::tools
