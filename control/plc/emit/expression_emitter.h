// SPDX-License-Identifier: Apache-2.0
// Emits checked expressions as C++.

#pragma once

#include <string>

#include "control/plc/emit/cpp_text.h"
#include "control/plc/emit/index_check.h"

namespace indurop::plc {

class ExpressionEmitter {
 public:
  explicit ExpressionEmitter(const Pou& pou) : pou_(pou) {}

  // Returns the value as a `to`. `exact`: of exactly that C++ type, for arguments of templates.
  [[nodiscard]] std::string value(const ast::Expression& expression, const Type& to, bool exact = false) const;
  // Returns the value as its own type.
  [[nodiscard]] std::string value(const ast::Expression& expression) const {
    return value(expression, *expression.type);
  }
  // Returns a variable that can be assigned or referred to.
  [[nodiscard]] std::string variable(const ast::Expression& expression) const { return raw(expression); }
  // Returns the call of the body of the instance in `instance`; for SUPER^ exactly the inherited body.
  [[nodiscard]] std::string run(const ast::Expression& callee, const std::string& instance) const;
  // Returns a variable as an argument for an ARRAY[*] of type `to`.
  [[nodiscard]] std::string slice(const ast::Expression& expression, const Type& to) const;
  // Returns "x = value" for an output of a call, converted; `text` is the output.
  [[nodiscard]] std::string assign_output(const ast::Argument& argument, const std::string& text,
                                          const Type& from) const;
  // Returns target = text, for bits too. Without ';'.
  [[nodiscard]] std::string assign(const ast::Expression& target, const std::string& text) const;

  // What is known of indices at the place that is emitted.
  [[nodiscard]] IndexCheck& index_check() noexcept { return index_check_; }

  [[nodiscard]] static std::string result_name(const Pou& pou);
  [[nodiscard]] std::string place(const Place& at) const { return cpp_place(at, pou_.title()); }

 private:
  // Returns code that faults at the place of `at` if the value is outside of the subrange.
  [[nodiscard]] std::string in_range(const ast::Expression& at, const std::string& text, const Type& to) const;
  [[nodiscard]] std::string raw(const ast::Expression& expression) const;
  [[nodiscard]] std::string name(const ast::Expression& expression) const;
  [[nodiscard]] std::string global(const Global& global) const;
  [[nodiscard]] std::string member(const ast::Expression& expression) const;
  [[nodiscard]] std::string callee(const ast::Expression& call) const;
  [[nodiscard]] std::string intrinsic(const ast::Expression& expression) const;
  [[nodiscard]] std::string index_through_pointer(const ast::Expression& expression) const;
  [[nodiscard]] std::string index(const ast::Expression& expression) const;
  [[nodiscard]] std::string one_index(const ast::Expression& expression, Bounds bounds) const;
  [[nodiscard]] std::string unary(const ast::Expression& expression) const;
  [[nodiscard]] std::string binary(const ast::Expression& expression) const;
  [[nodiscard]] std::string comparison(const ast::Expression& expression) const;
  [[nodiscard]] std::string logic(const ast::Expression& expression) const;
  // `text`: the type a joined text is assigned to; null: as it is.
  [[nodiscard]] std::string library_call(const ast::Expression& expression, const Type* text = nullptr) const;
  [[nodiscard]] std::string user_call(const ast::Expression& expression) const;

  const Pou& pou_;
  IndexCheck index_check_;
};

}  // namespace indurop::plc
