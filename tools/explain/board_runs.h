// SPDX-License-Identifier: Apache-2.0
// All runs of a board's modules, with what they began with and left of a few variables: from its tape while it runs, or
// from a recording.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/problem.h"
#include "explain/chain_follow.h"
#include "explain/facts.h"
#include "schema/schema.h"
#include "tape/follower.h"
#include "tools/values/node_choice.h"
#include "vars/store.h"

namespace indurop::tools {

class BoardRuns {
 public:
  // `wanted`: full names of variables. `board`: empty for a node of its own.
  BoardRuns(std::string board, std::vector<std::string> modules, std::vector<std::string> wanted);

  [[nodiscard]] const std::string& board() const noexcept { return board_; }
  [[nodiscard]] const std::vector<std::string>& wanted() const noexcept { return wanted_; }
  // A value that the next run of the module tells. Equal values have equal `value`, which is not 0.
  void tell(std::uint32_t module, std::size_t variable, tape::EntryKind kind, std::uint64_t value);
  // That run; `shift_ns` is added to its times.
  void end(std::uint32_t module, const tape::RunTail& tail, std::int64_t shift_ns);

  // What was known stays known, the runs go.
  void forget();

  // The runs of a module between two variables of a chain; empty names: none.
  [[nodiscard]] std::vector<explain::ChainRun> runs_of(const std::string& module, const std::string& before,
                                                       const std::string& behind) const;
  // All runs, for explain::keeping_of(); periods and cores are those of `modules`.
  [[nodiscard]] explain::Facts facts(const std::vector<explain::ModuleFact>& modules) const;

 private:
  struct Run {
    tape::RunTail tail;
    std::vector<std::uint64_t> before;  // by wanted variable
    std::vector<std::uint64_t> behind;
  };
  struct Module {
    std::string name;
    std::vector<std::uint64_t> known;   // by wanted variable: what its last entry told; 0: nothing yet
    std::vector<std::uint64_t> begin;   // of the run that is being told
    std::optional<std::uint64_t> next;  // number of its next run
    std::vector<Run> runs;
  };
  [[nodiscard]] std::size_t place_of(const std::string& variable) const;

  std::string board_;
  std::vector<std::string> wanted_;
  std::vector<Module> modules_;
};

// A number for the bytes of a value; never 0.
std::uint64_t value_number(std::span<const std::uint8_t> cdr);

// A board of this machine that is followed.
class FollowedBoard {
 public:
  // Errors: no such node, no tape.
  static Result<FollowedBoard, Failure> open(const std::string& node, const std::string& board,
                                             std::vector<std::string> wanted);
  // Leaves out what there is.
  void skip();
  // Takes what there is by now.
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

// The boards of a recording, whose configuration `config` is then. Errors: it cannot be read, or tells no runs.
Result<std::vector<BoardRuns>, base::Problem> recorded_runs(const std::filesystem::path& file,
                                                            const std::vector<std::string>& wanted);
// The configuration that a recording names; empty: none.
Result<std::string, base::Problem> recorded_config(const std::filesystem::path& file);

}  // namespace indurop::tools
