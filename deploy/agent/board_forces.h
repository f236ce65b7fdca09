// SPDX-License-Identifier: Apache-2.0
// Remote commands about values of this board's variables and its write lock, executed by calls of store/operate/. Not
// real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "core/base/problem.h"
#include "deploy/transaction/write_words.h"
#include "deploy/words/command_words.h"
#include "store/operate/hold.h"
#include "store/operate/who.h"
#include "store/vars/store.h"

namespace indurop::deploy {

class BoardForces {
 public:
  explicit BoardForces(std::string board) : board_(std::move(board)) {}

  // Executes Action::Force, Unforce, Set and SetLock: all of it or nothing; a problem names everything that is wrong.
  // Values must be within their declared range. `user`: verified, empty: a deployer; a lease is renewed and ended by
  // the one who has it only.
  Result<void, base::Problem> carry_out(const Command& command, const std::string& user);

 private:
  // The lease that a commander holds as long as it renews it.
  struct Held {
    operate::Lease lease;
    operate::Who who;
    std::string user;   // verified; empty: a deployer
    vars::Store store;  // store to which the lease belongs
  };
  Result<void, base::Problem> renew(const Command& command, const WriteOrder& order, const std::string& user);

  std::string board_;
  std::map<std::uint64_t, Held> leases_;  // by commander
};

// Returns why the board's write lock forbids commands to modules; empty if it does not.
std::string locked_against_commands(const std::string& board);

}  // namespace indurop::deploy
