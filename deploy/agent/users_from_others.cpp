// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/users_from_others.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "deploy/words/deployment_words.h"

namespace indurop::deploy {
namespace {

constexpr std::chrono::seconds kPatience{5};  // with one agent, however often it begins again
constexpr std::chrono::seconds kRound{60};

}  // namespace

void UsersFromOthers::step(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant,
                           rt::MonoTime now) {
  for (const BlobChunk& chunk : link.take_chunks()) {
    if (chunk.source == source_ && chunk.blob == blob_) {
      take(chunk, plant);
    }
  }
  if (source_ == 0 || now > until_) {
    ask_next(link, agents, plant, now);
  }
}

void UsersFromOthers::ask_next(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant,
                               rt::MonoTime now) {
  source_ = 0;
  if (now - round_ > kRound) {
    asked_.clear();
    round_ = now;
  }
  const auto next =
      std::find_if(agents.begin(), agents.end(), [&](std::uint64_t agent) { return !asked_.contains(agent); });
  if (next == agents.end()) {
    return;
  }
  source_ = *next;
  asked_.insert(source_);
  until_ = now + kPatience;
  blob_ = std::string(kUsersBlob) + users_.id(plant);
  text_ = TextPieces(kLargest);
  link.request({self_, source_, blob_, 0, kLargest, true});
}

void UsersFromOthers::take(const BlobChunk& chunk, const std::string& plant) {
  if (!text_.take(chunk) || !text_.done()) {
    return;
  }
  source_ = 0;
  if (!text_.whole()) {
    return;  // it has no newer one
  }
  const auto taken = users_.take(plant, text_.text());
  const std::string problem = taken ? std::string() : taken.error().text;
  if (taken) {
    log_.info("{}", *taken);
  } else if (problem != last_problem_) {
    log_.warning("a list of users that another board has was not taken: {}", problem);
  }
  last_problem_ = problem;
}

}  // namespace indurop::deploy
