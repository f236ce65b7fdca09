// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/board_history.h"

#include <optional>

#include "core/base/json.h"
#include "deploy/words/deployment_words.h"
#include "tools/client/board/board_texts.h"

namespace indurop::tools {
namespace {

// Returns nothing if the text is not in the format of this version's agents.
std::optional<std::vector<PastDeployment>> history_in(const std::string& text) {
  const base::Json whole = base::Json::parse(text).value_or(base::Json());
  if (!whole["history"].is_array()) {
    return std::nullopt;
  }
  std::vector<PastDeployment> history;
  for (const base::Json& entry : whole["history"].values()) {
    PastDeployment& past = history.emplace_back();
    if (!read(entry, "deployment", past.deployment) || !read(entry, "plant", past.plant) ||
        !read(entry, "generation", past.generation) || !read(entry, "host", past.host) ||
        !read(entry, "wall_ns", past.wall_ns) || !read(entry, "outcome", past.outcome)) {
      return std::nullopt;
    }
    (void)read(entry, "comment", past.comment);
  }
  return history;
}

}  // namespace

std::map<std::uint64_t, std::vector<PastDeployment>> fetch_histories(deploy::DeployLink& link, std::uint64_t self,
                                                                     const std::vector<std::uint64_t>& agents) {
  std::map<std::uint64_t, std::vector<PastDeployment>> all;
  for (const auto& [agent, text] : fetch_texts(link, self, deploy::kHistoryBlob, agents)) {
    if (auto history = history_in(text)) {
      all.emplace(agent, std::move(*history));
    }
  }
  return all;
}

}  // namespace indurop::tools
