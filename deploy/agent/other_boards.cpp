// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/other_boards.h"

#include "core/schema/topic_name.h"
#include "deploy/agent/trust_lists.h"

namespace indurop::deploy {
namespace {

constexpr std::size_t kMaxWarnings = 32;  // beyond this a participant may be inventing them

PassedList list_of_users(const BoardUsers& users) {
  return {"a list of users", std::string(kUsersBlob), [&users](const std::string& plant) { return users.id(plant); },
          [&users](const std::string& plant, const std::string& text) { return users.take(plant, text); }};
}

PassedList list_of_keys(const std::string& board, const DeployKeys& keys) {
  return {"a list of keys", std::string(kTrustBlob),
          [&keys](const std::string& plant) { return trust_id(keys, plant); },
          [board, &keys](const std::string& plant, const std::string& text) {
            return take_trust_list(board, keys, plant, "another board", text);
          }};
}

}  // namespace

OtherBoards::OtherBoards(const std::string& board, std::uint64_t self, const BoardUsers& users, const DeployKeys& keys,
                         const base::Log& log)
    : board_(board), log_(log), lists_(self, {list_of_users(users), list_of_keys(board, keys)}, log) {}

void OtherBoards::warn(const std::string& about) {
  if (warned_.size() < kMaxWarnings && warned_.insert(about).second) {
    log_.warning("{}", about);
  }
}

std::vector<std::string> OtherBoards::listen(DeployLink& link, const std::string& plant) {
  std::vector<std::string> boxes;
  for (auto& news : link.take_boards()) {
    const auto key = std::pair(news.report.board, news.report.agent);
    const bool same_plant = key.first != board_ && news.report.plant == plant;
    const auto why = news.gone ? box_watch_.gone(news.report) : box_watch_.note_report(news.report);
    if (why && same_plant) {
      boxes.push_back(*why);
    }
    if (news.gone) {
      boards_.erase(key);
    } else {
      boards_[key] = std::move(news.report);
    }
  }
  for (const OtherAgent& other : link.other_agents()) {
    warn(describe(other, schema::protocol()));
  }
  for (const Impostor& impostor : link.impostors()) {
    warn(describe(impostor));
  }
  return boxes;
}

void OtherBoards::step_lists(DeployLink& link, const std::string& plant, rt::MonoTime now) {
  lists_.step(link, agents_of(plant), plant, now);
}

std::vector<std::uint64_t> OtherBoards::agents_of(const std::string& plant) const {
  std::vector<std::uint64_t> agents;
  for (const auto& [key, other] : boards_) {
    if (key.first != board_ && !plant.empty() && other.plant == plant) {
      agents.push_back(key.second);
    }
  }
  return agents;
}

std::vector<std::uint64_t> OtherBoards::with_files_of(const std::string& plant, std::uint64_t first) const {
  std::vector<std::uint64_t> all = agents_of(plant);
  std::erase(all, first);
  all.insert(all.begin(), first);
  return all;
}

}  // namespace indurop::deploy
