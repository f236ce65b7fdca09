// SPDX-License-Identifier: Apache-2.0
// Values of this board's variables that somebody elsewhere wants set or held, as far as the board's write lock lets
// them, and that lock itself. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/problem.h"
#include "deploy/words/command_words.h"
#include "rt/clock.h"

namespace indurop::deploy {

class BoardForces {
 public:
  explicit BoardForces(std::string board) : board_(std::move(board)) {}

  // Action::Force, Unforce, Set and SetLock: all of it is done, or nothing, with a problem that names all that is
  // wrong. Values have to be within their declared range.
  Result<void, base::Problem> carry_out(const Command& command);

 private:
  // What a commander holds as long as it says so.
  struct Lease {
    std::vector<std::string> lines;  // NAME=VALUE
    rt::MonoTime until;
  };

  std::string board_;
  std::map<std::uint64_t, Lease> leases_;  // by commander
};

// Why the board's write lock forbids commands to modules; empty if it does not.
std::string locked_against_commands(const std::string& board);

}  // namespace indurop::deploy
