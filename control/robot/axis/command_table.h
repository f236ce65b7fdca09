// SPDX-License-Identifier: Apache-2.0
// Accepted commands that have not ended, whichever module executes them, and their status. A command whose place has
// been overwritten meanwhile continues, but its status is no longer reported.

#pragma once

#include <indurop/robot/commands.h>

namespace indurop::robot {

class CommandTable {
 public:
  static constexpr int kNone = -1;
  static constexpr int kMaxCommands = 64;

  // Called once per period. `known` is false while the commanding board has not been received. Commands that are there
  // the first time are not executed, but answered with Aborted. All functions of this class are real-time safe.
  void read(const Commands& places, bool known) noexcept;
  // Returns the next new command, in the order of their numbers; kNone: there is none.
  int take() noexcept;

  [[nodiscard]] const Command& command(int ticket) const noexcept { return at(ticket).command; }
  // Returns whether its block still has its Execute. False if no block waits for its answer any more.
  [[nodiscard]] bool execute(int ticket) const noexcept { return at(ticket).command.execute != 0; }
  // Returns whether its fields have changed since the last call.
  bool updated(int ticket) noexcept;

  void waits(int ticket) noexcept { tell(ticket, CommandState::Waits, ErrorCode::Ok); }
  void active(int ticket) noexcept { tell(ticket, CommandState::Active, ErrorCode::Ok); }
  // For motions without an end.
  void reached(int ticket, bool is) noexcept;
  // The command is done and keeps its effect: a stop that still has its Execute.
  void holds(int ticket) noexcept { tell(ticket, CommandState::Done, ErrorCode::Ok); }
  // The ticket is free afterwards.
  void end(int ticket, ErrorCode code) noexcept;

  [[nodiscard]] const CommandAnswers& answers() const noexcept { return answers_; }

 private:
  struct Entry {
    bool used = false;
    bool taken = false;
    bool changed = false;
    int place = kNone;  // kNone: overwritten
    Command command;
  };
  [[nodiscard]] const Entry& at(int ticket) const noexcept { return entries_[static_cast<std::size_t>(ticket)]; }
  Entry& at(int ticket) noexcept { return entries_[static_cast<std::size_t>(ticket)]; }
  void tell(int ticket, CommandState state, ErrorCode error) noexcept;
  void look(std::size_t place, const Command& now) noexcept;
  void enter(std::size_t place, const Command& now) noexcept;

  bool first_ = true;
  std::array<Entry, kMaxCommands> entries_{};
  std::array<int, kCommands> tickets_{};
  std::array<std::uint32_t, kCommands> seen_{};
  CommandAnswers answers_{};
};

}  // namespace indurop::robot
