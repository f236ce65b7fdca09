// SPDX-License-Identifier: Apache-2.0
// Resolves the names in an expression, determines its type, and computes values that are known at compile time. Each
// kind of expression has its checker; all of them check the expressions inside through this one.

#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "control/plc/check/call_checker.h"
#include "control/plc/check/context.h"
#include "control/plc/check/enumeration_casts.h"
#include "control/plc/check/initial_checker.h"
#include "control/plc/check/method_checker.h"
#include "control/plc/check/name_checker.h"
#include "control/plc/check/operation_checker.h"
#include "control/plc/check/pointer_checker.h"
#include "control/plc/check/write_checker.h"

namespace indurop::plc {

class ExpressionChecker {
 public:
  // How names are used.
  struct Mode {
    bool reading = true;    // names count as read
    bool following = true;  // a REFERENCE TO is replaced by the variable it refers to
  };

  explicit ExpressionChecker(Context& context);
  ExpressionChecker(const ExpressionChecker&) = delete;
  ExpressionChecker& operator=(const ExpressionChecker&) = delete;
  ExpressionChecker(ExpressionChecker&&) = delete;
  ExpressionChecker& operator=(ExpressionChecker&&) = delete;
  ~ExpressionChecker() = default;

  // Returns the type of the value; null after an error. `wanted`, the required type, only decides where the expression
  // itself is ambiguous: in SQRT(2.0) a REAL or an LREAL.
  const Type* value(ast::Expression& expression, const Type* wanted = nullptr);
  // As value(), but also accepts an instance of a function block.
  const Type* value_or_instance(ast::Expression& expression, const Type* wanted = nullptr);
  // As value_or_instance(), but also accepts a type or a namespace: the part before a dot. Null for these.
  const Type* typed(ast::Expression& expression, const Type* wanted);
  // Checks a value that is assigned to a `to`; returns false after an error. `what` begins the message: "x is a BOOL".
  bool assigned(ast::Expression& expression, const Type& to);
  // Checks the assignment of the result of a call that may have EN and ENO.
  const Type* top_call(ast::Expression& expression, const Type* wanted);
  // Checks a call as a statement: of functions and of instances of function blocks.
  void call_statement(ast::Expression& expression);
  // Returns the value of a whole number that is known at compile time.
  std::optional<std::int64_t> constant(ast::Expression& expression, std::string_view what);
  [[nodiscard]] bool is_whole(const Type& type) const noexcept;

  [[nodiscard]] const Mode& mode() const noexcept { return mode_; }
  // Returns what `check` returns, which runs in the mode.
  template <class Check>
  const Type* with(Mode mode, Check check) {
    const Mode before = std::exchange(mode_, mode);
    const Type* type = check();
    mode_ = before;
    return type;
  }

  NameChecker& names() noexcept { return names_; }
  MethodChecker& methods() noexcept { return methods_; }
  PointerChecker& pointers() noexcept { return pointers_; }
  OperationChecker& operations() noexcept { return operations_; }
  WriteChecker& writes() noexcept { return writes_; }
  EnumerationCasts& casts() noexcept { return casts_; }
  InitialChecker& initials() noexcept { return initials_; }
  CallChecker& calls() noexcept { return calls_; }

 private:
  const Type* literal(ast::Expression& expression, const Type* wanted);
  const Type* index(ast::Expression& expression);
  const Type* character(ast::Expression& expression, const Type& text);
  const Type* bit(ast::Expression& expression);
  const Type* part(ast::Expression& expression, const Type& base);

  Context& context_;
  Mode mode_;
  NameChecker names_;
  MethodChecker methods_;
  PointerChecker pointers_;
  OperationChecker operations_;
  WriteChecker writes_;
  EnumerationCasts casts_;
  InitialChecker initials_;
  CallChecker calls_;
};

// Returns what the checker learns of the expression.
[[nodiscard]] Resolved& resolved(ast::Expression& expression);
// Gives an untyped constant the type if it fits. Returns true if the value can be used as a `to` afterwards.
bool adapt(ast::Expression& expression, const Type& to);
// Converts a literal of one character to the CHAR or WCHAR that is required; returns whether it did.
bool adapt_character(ast::Expression& expression, const Type& to);
// Returns the known value of a checked expression, or null.
[[nodiscard]] const Constant* constant_of(const ast::Expression& expression) noexcept;
// Returns whether it is a number of another module that a contact or coil uses as a BOOL. `type`: its own type.
[[nodiscard]] bool counts_as_truth(const ast::Expression& expression, const Type& type) noexcept;

}  // namespace indurop::plc
