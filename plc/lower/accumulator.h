// SPDX-License-Identifier: Apache-2.0
// What an instruction list has loaded: an expression until it is stored, then a variable of the scan (_il1, ...).

#pragma once

#include <optional>
#include <set>
#include <string>

#include "plc/lower/lowered.h"

namespace indurop::plc::lower {

class Accumulator {
 public:
  // Statements and variables go to `lowered`, which is borrowed. `prefix`: of the names of variables.
  Accumulator(std::string prefix, Lowered& lowered) : prefix_(std::move(prefix)), lowered_(lowered) {}

  [[nodiscard]] bool loaded() const noexcept { return value_.has_value(); }
  void load(ast::Expression value);
  // What was computed from what was loaded. What becomes too deep for the passes behind is held in a variable.
  void combine(ast::Expression value);
  // What the variable holds, which is used already.
  void load_joint(const Place& at, const std::string& variable);
  // Empty afterwards.
  [[nodiscard]] std::optional<ast::Expression> take();
  void clear() noexcept { value_.reset(); }

  // These require that something is loaded.
  // For a statement. Unless nothing `follows` that could use it too, the value stays what it was when the statement
  // changes variables.
  [[nodiscard]] const ast::Expression& use(bool follows);
  void bring_to(const std::string& variable);

  // Before something else is loaded. What was computed and is used by nothing is computed nevertheless: it may call,
  // and it may be wrong.
  void drop();

 private:
  void hold();

  std::string prefix_;
  Lowered& lowered_;
  std::optional<ast::Expression> value_;
  bool used_ = true;  // by a statement
  std::set<std::string> brought_;
  int held_ = 0;
};

}  // namespace indurop::plc::lower
