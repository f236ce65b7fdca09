// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/lists_from_others.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace indurop::deploy {
namespace {

constexpr std::chrono::seconds kPatience{5};  // with one agent, however often it begins again
// A request is lost when the agent does not know this one yet; then it is sent again.
constexpr std::chrono::seconds kAnswer{1};
constexpr std::chrono::seconds kRound{60};

}  // namespace

void ListsFromOthers::step(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant,
                           rt::MonoTime now) {
  for (const BlobChunk& chunk : link.take_chunks()) {
    if (chunk.source == source_ && chunk.blob == blob_) {
      again_ = now + kAnswer;
      take(chunk, plant);
    }
  }
  if (source_ == 0 || now > until_) {
    ask_next(link, agents, plant, now);
  } else if (now > again_) {
    request(link, now);
  }
}

bool ListsFromOthers::has_asked(const std::vector<std::uint64_t>& agents) const {
  return source_ == 0 && std::all_of(agents.begin(), agents.end(), [&](std::uint64_t agent) {
           return asked_.contains({agent, lists_.size() - 1});
         });
}

void ListsFromOthers::ask_next(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant,
                               rt::MonoTime now) {
  source_ = 0;
  if (now - round_ > kRound) {
    asked_.clear();
    round_ = now;
  }
  for (const std::uint64_t agent : agents) {
    for (std::size_t list = 0; list < lists_.size(); ++list) {
      if (asked_.insert({agent, list}).second) {
        ask(link, agent, list, plant, now);
        return;
      }
    }
  }
}

void ListsFromOthers::ask(DeployLink& link, std::uint64_t agent, std::size_t list, const std::string& plant,
                          rt::MonoTime now) {
  source_ = agent;
  wanted_ = list;
  until_ = now + kPatience;
  blob_ = lists_[list].blob + lists_[list].id(plant);
  text_ = TextPieces(kLargest);
  request(link, now);
}

void ListsFromOthers::request(DeployLink& link, rt::MonoTime now) {
  again_ = now + kAnswer;
  link.request({self_, source_, blob_, 0, kLargest, true});
}

void ListsFromOthers::take(const BlobChunk& chunk, const std::string& plant) {
  if (!text_.take(chunk) || !text_.done()) {
    return;
  }
  source_ = 0;
  if (!text_.whole()) {
    return;  // it has no newer one
  }
  const auto taken = lists_[wanted_].take(plant, text_.text());
  const std::string problem = taken ? std::string() : taken.error().text;
  if (taken && !taken->empty()) {
    log_.info("{}", *taken);
  } else if (!taken && problem != last_problem_) {
    log_.warning("{} that another board has was not taken: {}", lists_[wanted_].what, problem);
  }
  last_problem_ = problem;
}

}  // namespace indurop::deploy
