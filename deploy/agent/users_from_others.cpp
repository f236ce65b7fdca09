// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/users_from_others.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "deploy/words/deployment_words.h"

namespace indurop::deploy {
namespace {

constexpr std::chrono::seconds kPatience{2};
constexpr std::chrono::seconds kRound{60};
constexpr std::size_t kLargest = 4U << 20U;

}  // namespace

void UsersFromOthers::step(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant,
                           rt::MonoTime now) {
  for (const BlobChunk& chunk : link.take_chunks()) {
    if (chunk.source == source_ && chunk.blob == blob_) {
      take(chunk, plant, now);
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
  text_.clear();
  link.request({self_, source_, blob_, 0, kLargest, true});
}

// The pieces come in order; the last one is not full.
void UsersFromOthers::take(const BlobChunk& chunk, const std::string& plant, rt::MonoTime now) {
  if (chunk.missing || chunk.offset != text_.size() || text_.size() + chunk.data.size() > kLargest) {
    source_ = 0;  // it has no newer one
    return;
  }
  until_ = now + kPatience;
  text_.append(chunk.data.begin(), chunk.data.end());
  if (chunk.data.size() == DeployLink::kChunk) {
    return;
  }
  source_ = 0;
  const auto taken = users_.take(plant, text_);
  const std::string problem = taken ? std::string() : taken.error().text;
  if (taken) {
    log_.info("{}", *taken);
  } else if (problem != last_problem_) {
    log_.warning("a list of users that another board has was not taken: {}", problem);
  }
  last_problem_ = problem;
}

}  // namespace indurop::deploy
