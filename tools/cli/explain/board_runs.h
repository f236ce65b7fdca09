// SPDX-License-Identifier: Apache-2.0
// All runs of a board's modules, with the values of a few variables before and after each run: from its tape while it
// runs, or from a recording.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/schema/schema.h"
#include "history/explain/chain_follow.h"
#include "history/explain/facts.h"
#include "store/tape/follower.h"
#include "store/vars/store.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {

class BoardRuns {
 public:
  // `wanted`: full names of variables. `board`: empty for a node that is not part of a plant.
  BoardRuns(std::string board, std::vector<std::string> modules, std::vector<std::string> wanted);

  [[nodiscard]] const std::string& board() const noexcept { return board_; }
  [[nodiscard]] const std::vector<std::string>& wanted() const noexcept { return wanted_; }
  // Adds a value that belongs to the next run of the module. Equal values have equal `value`, which is not 0.
  void add_value(std::uint32_t module, std::size_t variable, tape::EntryKind kind, std::uint64_t value);
  // Ends that run; `shift_ns` is added to its times.
  void end(std::uint32_t module, const tape::RunTail& tail, std::int64_t shift_ns);

  // Discards the runs; the last known values are kept.
  void forget();

  // Returns the runs of a module between two variables of a chain; empty names: no variable.
  [[nodiscard]] std::vector<explain::ChainRun> runs_of(const std::string& module, const std::string& before,
                                                       const std::string& behind) const;
  // Returns all runs, for explain::keeping_of(); periods and cores are taken from `modules`.
  [[nodiscard]] explain::Facts facts(const std::vector<explain::ModuleFact>& modules) const;

 private:
  struct Run {
    tape::RunTail tail;
    std::vector<std::uint64_t> before;  // by wanted variable
    std::vector<std::uint64_t> behind;
  };
  struct Module {
    std::string name;
    std::vector<std::uint64_t> known;   // by wanted variable: value of its last entry; 0: none yet
    std::vector<std::uint64_t> begin;   // values before the run whose entries are being read
    std::optional<std::uint64_t> next;  // number of its next run
    std::vector<Run> runs;
  };
  [[nodiscard]] std::size_t place_of(const std::string& variable) const;

  std::string board_;
  std::vector<std::string> wanted_;
  std::vector<Module> modules_;
};

// Returns a number that identifies the bytes of a value; never 0.
std::uint64_t value_number(std::span<const std::uint8_t> cdr);

// Follows the tape of a board of this machine.
class FollowedBoard {
 public:
  // Errors: no such node, no tape.
  static Result<FollowedBoard, Failure> open(const std::string& node, const std::string& board,
                                             std::vector<std::string> wanted);
  // Skips everything on the tape so far.
  void skip();
  // Reads everything on the tape so far.
  void take();
  [[nodiscard]] const BoardRuns& runs() const noexcept { return runs_; }

 private:
  FollowedBoard(vars::Store store, tape::Follower follower, BoardRuns runs)
      : store_(std::move(store)), follower_(std::move(follower)), runs_(std::move(runs)) {}
  vars::Store store_;
  tape::Follower follower_;
  BoardRuns runs_;
  std::map<std::uint32_t, std::size_t> places_;  // of wanted variables, by index in the directory
};

// Returns the boards of a recording of which `config` is the configuration. Errors: it cannot be read, or has no runs.
Result<std::vector<BoardRuns>, base::Problem> recorded_runs(const std::filesystem::path& file,
                                                            const std::vector<std::string>& wanted);
// Returns the configuration that a recording names; empty: none.
Result<std::string, base::Problem> recorded_config(const std::filesystem::path& file);

}  // namespace indurop::tools
