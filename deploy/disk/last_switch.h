// SPDX-License-Identifier: Apache-2.0
// switch.json of a board's platform/: the last time that the board switched to another release of the platform, and how
// far it is. The agent of a board ends in the middle of it, so the next one has to read what its predecessor agreed.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

inline constexpr const char* kSwitchFile = "switch.json";

struct LastSwitch {
  Order order;                // what was ordered; step, times and signature are left out
  bool joining = false;       // the board took the release over on its own
  std::uint64_t session = 0;  // of the agent, which its successor keeps
  std::int64_t begun_ns = 0;  // CLOCK_REALTIME
  std::uint64_t starts = 0;   // how often its agent was started before it was committed
  std::string ended;          // why the board went back; empty: it did not
  std::string installed;      // version of the installed release at that time
  bool expired = false;       // `ended` because the trial lasted too long: its agent hung, or there was no power
};

std::string switch_text(const LastSwitch& last);
// Returns nothing if the text is not what switch_text() creates.
std::optional<LastSwitch> read_switch(std::string_view text);

// The same in the folder of a board's releases. Nothing: there is none, or it is damaged.
std::optional<LastSwitch> load_switch(const std::filesystem::path& platform);
// Writes it durably, in one step.
Result<void, base::Problem> save_switch(const std::filesystem::path& platform, const LastSwitch& last);

}  // namespace indurop::deploy
