// SPDX-License-Identifier: Apache-2.0
// Commands to one board outside of deployments: stop, start or restart its node or one of its modules, hold values of
// its variables, have its black box kept or its runs recorded. The agent answers the first word with a number that
// counts once, so that a recorded command cannot be played again. No network here.

#pragma once

#include <cstdint>
#include <string>

namespace indurop::deploy {

enum class Action : std::uint8_t {
  StopModule,
  StartModule,
  RestartModule,
  StopNode,
  StartNode,
  RestartNode,
  Force,    // target: transaction/write_words.h
  Unforce,  // likewise
  KeepBox,  // target: why
  // What its runs see and write comes to a file on its disk. Target: the recording's name, "past" or "now" (where it
  // begins), then wanted variables or globs in a line each, none: all. Said again, it goes on: one that is not asked
  // for any more ends by itself. The answer to the first word names globs that no variable of the board matches, in a
  // line each; are these all, nothing is recorded.
  Record,
  EndRecord,   // target: its name. Unchanged: it had ended before, the text says why
  DropRecord,  // target: its name; its file was fetched
  SetLock,     // target: transaction/write_words.h
  Set,         // likewise
  // What people do about alarms. Target: transaction/write_words.h with names of alarms as lines, none: all. The answer
  // is a JSON array of those that it was done to.
  AckAlarms,
  ShelveAlarms,  // for so long
  UnshelveAlarms,
};

struct Command {
  std::uint64_t commander = 0;  // this run of whoever commands
  std::string host;             // of it, for people
  std::string board;
  std::uint64_t agent = 0;  // of the board that is meant
  std::string plant;        // what the board runs
  Action action = Action::StopModule;
  std::string target;       // the module; empty: the node; of other actions, see there
  std::uint64_t nonce = 0;  // as the agent gave it; 0: asks for one
  std::string signature;    // of command_text(); empty: unsigned
};

enum class Outcome : std::uint8_t {
  Nonce,      // say it again with this number
  UnderWay,   // taken, not done yet
  Done,       // it is as commanded
  Unchanged,  // it was so before
  Failed,     // see text
  Refused,    // likewise; nothing was changed
};

struct CommandReply {
  std::uint64_t commander = 0;
  std::string board;
  std::uint64_t agent = 0;
  std::uint64_t nonce = 0;
  Outcome outcome = Outcome::Refused;
  std::string text;
};

// What is signed.
std::string command_text(const Command& command);

}  // namespace indurop::deploy
