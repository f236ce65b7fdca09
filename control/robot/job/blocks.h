// SPDX-License-Identifier: Apache-2.0
// Statements of blocks that END closes: IF, WHILE, FOR, LOOP and TRY.

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
  void try_block();
  void recover();
  void end_block();
  // The job ends: each block without END is an error.
  void end();

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Block {
    const char* word = "";
    std::size_t line = 0;
    std::size_t start = 0;            // first step of the block
    std::size_t pending = kNone;      // step that jumps past this part of the block
    std::vector<std::size_t> ends{};  // steps that jump past the block
    int counter = -1;                 // variable of FOR
    double by = 1;
    bool has_else = false;
  };

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
  std::vector<Block> blocks_;
};

}  // namespace indurop::robot
