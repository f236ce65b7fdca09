// SPDX-License-Identifier: Apache-2.0
// Decides which indices of arrays are checked while the program runs, and which need no check since they cannot leave
// the array.

#pragma once

#include <map>

#include "control/plc/check/program.h"

namespace indurop::plc {

class IndexCheck {
 public:
  // The variable of a loop stays within these values while the loop runs.
  void enter_loop(const Variable& variable, Bounds values) { loops_[&variable] = values; }
  void leave_loop(const Variable& variable) { loops_.erase(&variable); }

  // Returns false if the value of `index` is known to be within the bounds: it is the variable of a surrounding loop,
  // plus or minus a constant.
  [[nodiscard]] bool is_needed(const ast::Expression& index, Bounds bounds) const;

 private:
  std::map<const Variable*, Bounds> loops_;
};

}  // namespace indurop::plc
