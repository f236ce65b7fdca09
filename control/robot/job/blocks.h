// SPDX-License-Identifier: Apache-2.0
// Statements of blocks that END closes: IF, WHILE, FOR, LOOP, SWITCH and TRY, and the ELSE of a WAIT or ASK.

#pragma once

#include <cstddef>
#include <vector>

#include "control/robot/job/statement.h"

namespace indurop::robot {

class BlockReader {
 public:
  explicit BlockReader(const StatementParts& parts)
      : line_(parts.line), draft_(parts.draft), names_(parts.names), expressions_(parts.expressions) {}

  // Begins a job.
  void begin() { blocks_.clear(); }
  void if_goto();
  void otherwise(bool condition);
  void while_block();
  void for_block();
  void loop();
  void switch_block();
  void case_of();
  void case_default();
  // Leaves the innermost loop.
  void exit();
  // Reads the ELSE after a WAIT or an ASK, if there is one.
  void timeout_else();
  void try_block();
  void recover();
  void end_block();
  // Number of blocks that are open.
  [[nodiscard]] std::size_t depth() const noexcept { return blocks_.size(); }
  // The job ends: each block without END is an error.
  void end();

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  enum class Kind { If, While, For, Loop, Switch, Wait, Ask, Try };
  struct Block {
    Kind kind = Kind::If;
    std::size_t line = 0;
    std::size_t start = 0;            // first step of the block
    std::size_t pending = kNone;      // step that jumps past this part of the block
    std::vector<std::size_t> ends{};  // steps that jump past the block
    int counter = -1;                 // variable of FOR and SWITCH
    double by = 1;
    bool has_else = false;
  };
  static const char* word_of(Kind kind) noexcept;
  static bool repeats(Kind kind) noexcept;
  Block& open(Kind kind, std::size_t start, std::size_t pending);
  [[nodiscard]] bool is_in(Kind kind) const noexcept { return !blocks_.empty() && blocks_.back().kind == kind; }
  void begin_part(Block& block);
  int hidden_variable(const JobToken& at);

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
  std::vector<Block> blocks_;
};

}  // namespace indurop::robot
