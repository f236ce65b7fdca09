// SPDX-License-Identifier: Apache-2.0
// The answer of `indurop explain`: one sentence, the culprit if it is known, and the evidence.

#pragma once

#include <string>
#include <vector>

namespace indurop::explain {

enum class Cause {
  NotKnown,   // the text says why not
  AllIsWell,  // it ran in time, the value is new, the board is there
  NotDue,     // not due by the schedule
  OwnTime,    // the culprit is a module that took longer than usual
  Fault,      // the culprit is a module that faulted
  Stopped,    // the culprit is the user who stopped it
  Machine,    // no module: the kernel, other programs, the hypervisor
  Schedule,   // no module took longer than usual: too much is due at once
  Board,      // the culprit is a board that ended or crashed
  Network,    // the culprit is a cable or a device between two boards
  Rate,       // not sent more often than this
  Unchanged,  // its writer runs but does not change it
  Nobody,     // no module writes it
  Force,      // the culprit is the user who forced it
  Set,        // the culprit is the user who set it
  Module,     // the culprit is the module that wrote it
  Device,     // the culprit is a field device
};
const char* to_text(Cause cause) noexcept;

struct Answer {
  Cause cause = Cause::NotKnown;
  std::string culprit;  // a module, a board, a user; empty: not known
  std::string text;
  std::vector<std::string> evidence;
};

inline Answer not_known(std::string why) {
  return {Cause::NotKnown, {}, "Not known, because " + std::move(why), {}};
}

}  // namespace indurop::explain
