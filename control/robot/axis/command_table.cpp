// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/command_table.h"

namespace indurop::robot {

void CommandTable::read(const Commands& places, bool known) noexcept {
  if (!known) {
    return;
  }
  if (first_) {
    first_ = false;
    tickets_.fill(kNone);
    for (std::size_t i = 0; i < kCommands; ++i) {
      // Commands from before this program started are not executed.
      seen_[i] = places[i].number;
      answers_[i] = {seen_[i], seen_[i] == 0 ? CommandState::None : CommandState::Aborted, ErrorCode::Ok, false};
    }
    return;
  }
  for (std::size_t i = 0; i < kCommands; ++i) {
    look(i, places[i]);
  }
}

void CommandTable::look(std::size_t place, const Command& now) noexcept {
  const int ticket = tickets_[place];
  if (now.number == seen_[place]) {
    if (ticket != kNone) {
      Entry& entry = at(ticket);
      entry.changed = entry.changed || now.updates != entry.command.updates;
      if (now.updates != entry.command.updates) {
        entry.command = now;
      }
      entry.command.execute = now.execute;
    }
    return;
  }
  seen_[place] = now.number;
  if (ticket != kNone) {
    at(ticket).place = kNone;
    at(ticket).command.execute = 0;
    tickets_[place] = kNone;
  }
  // An empty place keeps its last answer: it shows which numbers there have been.
  if (now.number != 0) {
    answers_[place] = {now.number, CommandState::None, ErrorCode::Ok, false};
    enter(place, now);
  }
}

void CommandTable::enter(std::size_t place, const Command& now) noexcept {
  for (int ticket = 0; ticket < kMaxCommands; ++ticket) {
    if (!at(ticket).used) {
      at(ticket) = {true, false, false, static_cast<int>(place), now};
      tickets_[place] = ticket;
      tell(ticket, CommandState::Waits, ErrorCode::Ok);
      return;
    }
  }
  answers_[place] = {now.number, CommandState::Error, ErrorCode::Full, false};
}

int CommandTable::take() noexcept {
  int first = kNone;
  for (int ticket = 0; ticket < kMaxCommands; ++ticket) {
    const Entry& entry = at(ticket);
    // Numbers may wrap around.
    if (entry.used && !entry.taken &&
        (first == kNone || static_cast<std::int32_t>(entry.command.number - at(first).command.number) < 0)) {
      first = ticket;
    }
  }
  if (first != kNone) {
    at(first).taken = true;
  }
  return first;
}

bool CommandTable::updated(int ticket) noexcept {
  const bool changed = at(ticket).changed;
  at(ticket).changed = false;
  return changed;
}

void CommandTable::tell(int ticket, CommandState state, ErrorCode error) noexcept {
  const int place = at(ticket).place;
  if (place != kNone) {
    CommandAnswer& answer = answers_[static_cast<std::size_t>(place)];
    answer.state = state;
    answer.error = error;
    // A command that replaces another one as it is reached: both are reported in the same period.
    answer.reached = answer.reached && (state == CommandState::Active || state == CommandState::Aborted);
  }
}

void CommandTable::reached(int ticket, bool is) noexcept {
  const int place = at(ticket).place;
  if (place != kNone) {
    answers_[static_cast<std::size_t>(place)].reached = is;
  }
}

void CommandTable::end(int ticket, ErrorCode code) noexcept {
  tell(ticket,
       code == ErrorCode::Ok        ? CommandState::Done
       : code == ErrorCode::Aborted ? CommandState::Aborted
                                    : CommandState::Error,
       code == ErrorCode::Aborted ? ErrorCode::Ok : code);
  if (at(ticket).place != kNone) {
    tickets_[static_cast<std::size_t>(at(ticket).place)] = kNone;
  }
  at(ticket).used = false;
}

}  // namespace indurop::robot
