// SPDX-License-Identifier: Apache-2.0
// The accumulator of an instruction list: an expression until it is stored, then a variable of the scan (_il1, ...).

#pragma once

#include <optional>
#include <set>
#include <string>

#include "control/plc/lower/lowered.h"

namespace indurop::plc::lower {

class Accumulator {
 public:
  // Statements and variables go to `lowered`, which is borrowed. `prefix` begins the names of variables.
  Accumulator(std::string prefix, Lowered& lowered) : prefix_(std::move(prefix)), lowered_(lowered) {}

  [[nodiscard]] bool loaded() const noexcept { return value_.has_value(); }
  void load(ast::Expression value);
  // Sets a value computed from the loaded one. A value that becomes too deep for later passes is stored in a variable.
  void combine(ast::Expression value);
  // Loads the value of the variable, which counts as used.
  void load_joint(const Place& at, const std::string& variable);
  // Returns the value; the accumulator is empty afterwards.
  [[nodiscard]] std::optional<ast::Expression> take();
  void clear() noexcept { value_.reset(); }

  // These require that something is loaded.
  // Returns the value for a statement. Unless nothing that `follows` could use it too, the value stays the same when
  // the statement changes variables.
  [[nodiscard]] const ast::Expression& use(bool follows);
  void bring_to(const std::string& variable);

  // Call it before another value is loaded. A computed value that nothing uses is computed nevertheless: it may contain
  // calls, and it may be wrong.
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
