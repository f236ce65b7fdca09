// SPDX-License-Identifier: Apache-2.0
#include "tools/board_history.h"

#include <nlohmann/json.hpp>

#include "deploy/deployment_words.h"
#include "tools/board_texts.h"

namespace indurop::tools {

std::vector<PastDeployment> fetch_history(mirror::DeployLink& link, std::uint64_t self, std::uint64_t agent) {
  using Json = nlohmann::json;
  const auto texts = fetch_texts(link, self, deploy::kHistoryBlob, {agent});
  const auto text = texts.find(agent);
  const Json whole = Json::parse(text == texts.end() ? "" : text->second, nullptr, false);
  std::vector<PastDeployment> history;
  try {
    for (const Json& entry : whole.at("history")) {
      history.push_back({entry.at("deployment").get<std::string>(), entry.at("plant").get<std::string>(),
                         entry.at("generation").get<std::uint64_t>(), entry.at("host").get<std::string>(),
                         entry.at("wall_ns").get<std::int64_t>(), entry.at("outcome").get<std::string>()});
    }
  } catch (const Json::exception&) {
    history.clear();  // not what an agent of this version says
  }
  return history;
}

}  // namespace indurop::tools
