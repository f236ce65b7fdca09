// SPDX-License-Identifier: Apache-2.0
#include "tools/board_history.h"

#include <nlohmann/json.hpp>

#include "deploy/deployment_words.h"
#include "rt/clock.h"
#include "tools/interrupt.h"

namespace indurop::tools {
namespace {

using Json = nlohmann::json;

constexpr std::int64_t kPatienceNs = 2'000'000'000;
constexpr std::int64_t kAskAgainNs = 250'000'000;
constexpr std::int64_t kLookNs = 20'000'000;
constexpr std::uint64_t kLargest = mirror::DeployLink::kChunk;  // some twenty short entries

std::string fetch(mirror::DeployLink& link, std::uint64_t self, std::uint64_t agent) {
  const std::int64_t end = rt::now_ns() + kPatienceNs;
  std::int64_t ask = 0;
  while (!interrupted() && rt::now_ns() < end) {
    if (rt::now_ns() >= ask) {
      link.request({self, agent, deploy::kHistoryBlob, 0, kLargest, true});
      ask = rt::now_ns() + kAskAgainNs;
    }
    link.wait(rt::now_ns() + kLookNs);
    for (const deploy::BlobChunk& chunk : link.take_chunks()) {
      if (chunk.source == agent && chunk.blob == deploy::kHistoryBlob && chunk.offset == 0) {
        return {chunk.data.begin(), chunk.data.end()};
      }
    }
  }
  return {};
}

}  // namespace

std::vector<PastDeployment> fetch_history(mirror::DeployLink& link, std::uint64_t self, std::uint64_t agent) {
  const Json whole = Json::parse(fetch(link, self, agent), nullptr, false);
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
