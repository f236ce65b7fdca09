// SPDX-License-Identifier: Apache-2.0
// What `indurop explain` says: one sentence, who is to blame if that is known, and what shows it.

#pragma once

#include <string>
#include <vector>

namespace indurop::explain {

enum class Cause {
  NotKnown,   // the text says why not
  AllIsWell,  // it ran in time, the value is new, the board is there
  NotDue,     // the schedule says so
  OwnTime,    // the culprit is a module that took longer than usual
  Fault,      // the culprit is a module that faulted
  Stopped,    // the culprit is who stopped it
  Machine,    // no module: the kernel, other programs, the machine below
  Schedule,   // nobody took longer than usual: too much is due at once
  Board,      // the culprit is a board that ended or crashed
  Network,    // the culprit is a cable or what is between two boards
  Rate,       // sent no more often than this
  Unchanged,  // its writer runs and leaves it as it is
  Nobody,     // no module writes it
  Force,      // the culprit is who forced it
  Set,        // the culprit is who set it
  Module,     // the culprit is the module that wrote it
};
const char* to_text(Cause cause) noexcept;

struct Answer {
  Cause cause = Cause::NotKnown;
  std::string culprit;  // a module, a board, a user; empty: none is known
  std::string text;
  std::vector<std::string> evidence;
};

inline Answer not_known(std::string why) {
  return {Cause::NotKnown, {}, "I do not know, because " + std::move(why), {}};
}

}  // namespace indurop::explain
