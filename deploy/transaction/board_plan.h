// SPDX-License-Identifier: Apache-2.0
// What a deployment does to each module of a board: a board says it before anything is changed.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::deploy {

struct ModulePlan {
  enum class Act : std::uint8_t {
    Kept,       // the same file: it goes on
    Exchanged,  // its new version continues with what it keeps
    Fresh,      // its new version begins with its initial values
    Open,       // its new process will tell whether it continues with what it keeps
    Rescheduled,
    Added,
    Ended,
    Restarted,
    Refused,  // its new version cannot run
  };
  std::string module;
  Act act = Act::Kept;
  std::string why;
};
// As people read it: "exchanged with state".
const char* to_text(ModulePlan::Act act) noexcept;

// What happens to a pool that the board sends or receives.
struct PoolPlan {
  std::string pool;
  ModulePlan::Act act = ModulePlan::Act::Kept;
  std::string why;  // "sent to control"
};

struct BoardPlan {
  std::string restart;  // why the node cannot go on; empty: it can
  std::vector<ModulePlan> modules;
  std::vector<PoolPlan> pools{};
  std::uint64_t tick = 0;           // first tick with the new versions; 0: nothing was exchanged
  std::uint64_t schedule_tick = 0;  // first tick of the new schedule; 0: the schedule stays
  std::uint64_t left_out = 0;       // ticks without new values of a module, at most
};
std::string text_of(const BoardPlan& plan);
// Returns nothing if the text is no plan.
std::optional<BoardPlan> parse_board_plan(std::string_view text);

// The plan of a board whose node is restarted.
BoardPlan restarted(BoardPlan plan);

}  // namespace indurop::deploy
