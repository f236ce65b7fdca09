// SPDX-License-Identifier: Apache-2.0
// Takes the list of users of the plant from other boards, so that one that was off or not reached learns of changes:
// asks each agent when it appears and all of them in turn later, for a list that is newer than the board's own.

#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/agent/board_users.h"
#include "deploy/link/deploy_link.h"
#include "deploy/link/text_pieces.h"

namespace indurop::deploy {

class UsersFromOthers {
 public:
  UsersFromOthers(std::uint64_t self, const BoardUsers& users, const base::Log& log)
      : self_(self), users_(users), log_(log) {}

  // `agents`: of the other boards of `plant`, which this board runs.
  void step(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant, rt::MonoTime now);

 private:
  static constexpr std::size_t kLargest = 4U << 20U;  // bytes of a list

  void ask_next(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant, rt::MonoTime now);
  void take(const BlobChunk& chunk, const std::string& plant);

  std::uint64_t self_;
  const BoardUsers& users_;
  const base::Log& log_;
  std::set<std::uint64_t> asked_;  // in this round
  rt::MonoTime round_;             // when it began
  std::uint64_t source_ = 0;       // the agent that is asked; 0: none
  rt::MonoTime until_;             // until then its answer is waited for
  std::string blob_;
  TextPieces text_{kLargest};  // of its answer
  std::string last_problem_;   // logged once
};

}  // namespace indurop::deploy
