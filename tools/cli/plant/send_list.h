// SPDX-License-Identifier: Apache-2.0
// Sends a list of a plant (its users, its valid keys) to its boards and shows what each answered.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "deploy/words/command_words.h"
#include "tools/client/board/board_commander.h"
#include "tools/client/board/board_roster.h"
#include "tools/console/context.h"

namespace indurop::tools {

inline constexpr std::int64_t kSendNs = 5'000'000'000;  // to discover boards, and for the answer of each

struct SentList {
  deploy::Action action;
  std::string text;
  std::string taken;      // what a board has now: "has 3 users now"
  std::string unchanged;  // what it had before: "has this list already"
};

// Which boards get it.
struct Addressed {
  std::string plant;
  bool idle = false;                 // also boards that run nothing
  std::vector<std::string> revoked;  // that nothing is expected from
};

// Sends it to the boards. Names those that others know and that were not discovered. Returns the exit code.
int send_list(Context& context, deploy::DeployLink& link, std::uint64_t self, BoardCommander& commander,
              const BoardRoster& roster, const Addressed& boards, const SentList& list);

}  // namespace indurop::tools
