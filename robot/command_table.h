// SPDX-License-Identifier: Apache-2.0
// Commands that were taken and have not ended, whoever carries them out, and what is told of them. A command whose
// place has been written anew meanwhile goes on; nobody is told of it any more.

#pragma once

#include <indurop/robot/commands.h>

namespace indurop::robot {

class CommandTable {
 public:
  static constexpr int kNone = -1;
  static constexpr int kMost = 64;

  // Once per period. `known` is false while the board of who commands has not been heard. What is there the first time
  // is not carried out, but answered with Aborted. Real-time safe, as all here.
  void read(const Commands& places, bool known) noexcept;
  // The next new command, in the order of their numbers; kNone: there is none.
  int take() noexcept;

  [[nodiscard]] const Command& command(int ticket) const noexcept { return at(ticket).command; }
  // Whether its block still has its Execute. False if nobody waits for its answer any more.
  [[nodiscard]] bool execute(int ticket) const noexcept { return at(ticket).command.execute != 0; }
  // Its fields have changed since this was asked last.
  bool updated(int ticket) noexcept;

  void waits(int ticket) noexcept { tell(ticket, CommandState::Waits, ErrorCode::Ok); }
  void active(int ticket) noexcept { tell(ticket, CommandState::Active, ErrorCode::Ok); }
  // Of motions without an end.
  void reached(int ticket, bool is) noexcept;
  // It is done and holds on: a stop whose Execute is still there.
  void holds(int ticket) noexcept { tell(ticket, CommandState::Done, ErrorCode::Ok); }
  // The ticket is free afterwards.
  void end(int ticket, ErrorCode code) noexcept;

  [[nodiscard]] const CommandAnswers& answers() const noexcept { return answers_; }

 private:
  struct Entry {
    bool used = false;
    bool taken = false;
    bool changed = false;
    int place = kNone;  // kNone: written anew
    Command command;
  };
  [[nodiscard]] const Entry& at(int ticket) const noexcept { return entries_[static_cast<std::size_t>(ticket)]; }
  Entry& at(int ticket) noexcept { return entries_[static_cast<std::size_t>(ticket)]; }
  void tell(int ticket, CommandState state, ErrorCode error) noexcept;
  void look(std::size_t place, const Command& now) noexcept;
  void enter(std::size_t place, const Command& now) noexcept;

  bool first_ = true;
  std::array<Entry, kMost> entries_{};
  std::array<int, kCommands> tickets_{};
  std::array<std::uint32_t, kCommands> seen_{};
  CommandAnswers answers_{};
};

}  // namespace indurop::robot
