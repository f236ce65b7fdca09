// SPDX-License-Identifier: Apache-2.0
// The agents of other boards that this one has discovered, and notes about them for people.

#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/agent/board_users.h"
#include "deploy/agent/box_watch.h"
#include "deploy/agent/deploy_keys.h"
#include "deploy/agent/lists_from_others.h"
#include "deploy/link/deploy_link.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class OtherBoards {
 public:
  // `self`: this agent; `users` and `keys`: of this board.
  OtherBoards(const std::string& board, std::uint64_t self, const BoardUsers& users, const DeployKeys& keys,
              const base::Log& log);

  // Processes what has arrived. Returns why boards of `plant` keep their black boxes, if any does.
  std::vector<std::string> listen(DeployLink& link, const std::string& plant);
  // The latest report of each agent, by board and agent; this board's own is included.
  [[nodiscard]] const std::map<std::pair<std::string, std::uint64_t>, BoardReport>& all() const noexcept {
    return boards_;
  }
  // Returns the sessions that may have files of a deployment of the plant: `first`, then the agents of its boards.
  [[nodiscard]] std::vector<std::uint64_t> with_files_of(const std::string& plant, std::uint64_t first) const;
  // Takes newer lists of users and of valid keys from them. Receives the pieces of files that arrive: not while a
  // Fetcher is active.
  void step_lists(DeployLink& link, const std::string& plant, rt::MonoTime now);
  // Returns true if all other boards of the plant were asked for these lists.
  [[nodiscard]] bool know_lists(const std::string& plant) const { return lists_.has_asked(agents_of(plant)); }
  void clear() { boards_.clear(); }

 private:
  // Returns the agents of the other boards of the plant.
  [[nodiscard]] std::vector<std::uint64_t> agents_of(const std::string& plant) const;
  void warn(const std::string& about);

  std::string board_;
  const base::Log& log_;
  std::map<std::pair<std::string, std::uint64_t>, BoardReport> boards_;
  std::set<std::string> warned_;
  BoxWatch box_watch_;
  ListsFromOthers lists_;
};

}  // namespace indurop::deploy
