// SPDX-License-Identifier: Apache-2.0
// Orders from elsewhere about values of this board's variables and its write lock: what a command says becomes a call
// of operate/. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "base/problem.h"
#include "deploy/transaction/write_words.h"
#include "deploy/words/command_words.h"
#include "operate/hold.h"
#include "operate/who.h"
#include "vars/store.h"

namespace indurop::deploy {

class BoardForces {
 public:
  explicit BoardForces(std::string board) : board_(std::move(board)) {}

  // Action::Force, Unforce, Set and SetLock: all of it is done, or nothing, with a problem that names all that is
  // wrong. Values have to be within their declared range.
  Result<void, base::Problem> carry_out(const Command& command);

 private:
  // What a commander holds as long as it renews it.
  struct Held {
    operate::Lease lease;
    operate::Who who;
    vars::Store store;  // that the lease is of
  };
  Result<void, base::Problem> renew(const Command& command, const WriteOrder& order);

  std::string board_;
  std::map<std::uint64_t, Held> leases_;  // by commander
};

// Why the board's write lock forbids commands to modules; empty if it does not.
std::string locked_against_commands(const std::string& board);

}  // namespace indurop::deploy
