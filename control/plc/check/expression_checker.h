// SPDX-License-Identifier: Apache-2.0
// Resolves the names in an expression, determines its type, and computes values that are known at compile time.

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker {
 public:
  explicit ExpressionChecker(Context& context) : context_(context) {}

  // Returns the type of the value; null after an error. `wanted`, the required type, only decides where the expression
  // itself is ambiguous: in SQRT(2.0) a REAL or an LREAL.
  const Type* value(ast::Expression& expression, const Type* wanted = nullptr);
  // As value(), but also accepts an instance of a function block.
  const Type* value_or_instance(ast::Expression& expression, const Type* wanted = nullptr);
  // Checks a value that is assigned to a `to`; returns false after an error. `what` begins the message: "x is a BOOL".
  bool assigned(ast::Expression& expression, const Type& to);
  // Checks a variable that is written; returns its type, null after an error.
  const Type* target(ast::Expression& expression, bool instances = false);
  // Returns whether it is a number of another module that a contact or coil uses as a BOOL. `type`: its own type.
  [[nodiscard]] static bool counts_as_truth(const ast::Expression& expression, const Type& type) noexcept;
  // Checks a variable that is passed by reference, read and written.
  const Type* reference(ast::Expression& expression);
  // Checks a call as a statement: of functions and of instances of function blocks.
  void call_statement(ast::Expression& expression);
  // Returns whether the call is one of an action of another instance.
  [[nodiscard]] bool is_action(ast::Expression& callee);
  [[nodiscard]] bool is_whole(const Type& type) const noexcept;
  // Returns the variable at the root of x.a[3].b: x.
  static const ast::Expression& root_of(const ast::Expression& expression) noexcept;
  // Returns p of p^.x and p[3].x; null if the value is not reached through a pointer.
  static const ast::Expression* through_pointer(const ast::Expression& expression) noexcept;
  // Checks a REFERENCE TO without following it: the target of REF=.
  const Type* reference_itself(ast::Expression& expression);
  // Returns whether the expression is in an ARRAY[*], and reports that as an error.
  bool is_open(const ast::Expression& expression);
  // Turns the expression into the address of its variable.
  bool bind(ast::Expression& expression, const Type& to);
  // Checks the assignment of the result of a call that may have EN and ENO.
  const Type* top_call(ast::Expression& expression, const Type* wanted);
  // Turns x.Speed := value, where Speed is a PROPERTY, into a call. Returns false and changes nothing if it is not one.
  bool write_property(ast::Statement& statement);
  // Returns the value of a whole number that is known at compile time.
  std::optional<std::int64_t> constant(ast::Expression& expression, std::string_view what);
  // Checks an initial value; returns false after an error.
  bool initial(ast::Initial& initial, const Type& type);

 private:
  friend class CallChecker;
  [[nodiscard]] static Resolved& resolved(ast::Expression& expression);

  const Type* typed(ast::Expression& expression, const Type* wanted);
  const Type* literal(ast::Expression& expression, const Type* wanted);
  const Type* name(ast::Expression& expression, const Type* wanted);
  const Type* enum_value(ast::Expression& expression, const Type& type, std::string_view item);
  const Type* direct(ast::Expression& expression);
  const Type* global(ast::Expression& expression, Global& global);
  const Type* member(ast::Expression& expression);
  // Returns the type of the pin; null if the block has none of that name.
  const Type* library_pin(ast::Expression& expression, const LibraryBlock& block);
  const Type* block_member(ast::Expression& expression, const Type& block);
  // Reports that the instance has no such member and suggests one.
  void no_member(const ast::Expression& expression, const Type& block);
  const Type* namespace_member(ast::Expression& expression, const std::string& path);
  const Type* index(ast::Expression& expression);
  const Type* bit(ast::Expression& expression);
  const Type* part(ast::Expression& expression, const Type& base);
  const Type* named_bit(ast::Expression& expression, const Type& base);
  const Type* unary(ast::Expression& expression, const Type* wanted);
  const Type* binary(ast::Expression& expression, const Type* wanted);
  const Type* this_or_super(ast::Expression& expression);
  bool variable_of_this(ast::Expression& expression);
  bool can_see(Variable& variable, const Place& at);
  bool may_call(const Pou& method, const Place& at);
  const Type* object(ast::Expression& expression);
  const Pou* accessor(const Pou& pou, const ast::Expression& expression, ast::Accessor which);
  const Type* read_property(ast::Expression& expression, const Pou& getter);
  bool assigned_interface(ast::Expression& expression, const Type& to);
  // The value as another type: an enumeration is a number, and a number one of an enumeration.
  const Type* deref(ast::Expression& expression);
  const Type* character(ast::Expression& expression, const Type& text);
  const Type* pointer_index(ast::Expression& expression, const Type& pointer);
  const Type* follow(ast::Expression& expression, const Type& reference);
  const Type* pointer_operation(ast::Expression& expression);
  const Type* pointer_comparison(ast::Expression& expression);
  bool assigned_pointer(ast::Expression& expression, const Type& to);
  void complain_of_range(const Place& at, const Type& type, const Type& to);
  void cast(ast::Expression& expression, const Type& to);
  void count_enumerations(ast::Expression& expression);
  bool convert_enumeration(ast::Expression& expression, const Type& to);
  [[nodiscard]] bool is_no_variable(const ast::Expression& expression) const;
  bool sides(ast::Expression& expression, const Type* wanted);
  const Type* comparison(ast::Expression& expression);
  const Type* logic(ast::Expression& expression, const Type* wanted);
  const Type* arithmetic(ast::Expression& expression, const Type* wanted);
  void fold(ast::Expression& expression, const Type& operand);
  bool meet(ast::Expression& a, ast::Expression& b);
  const Type* bare_enum_value(ast::Expression& expression, const Type* wanted,
                              std::pair<std::string, std::string>& both);
  const Type* unknown(ast::Expression& expression, const Type* wanted);
  // Returns the instance through which other POUs use a program by its name; null if there is no such program, or the
  // dialect does not support that.
  Global* program_named(std::string_view name);
  void note_write(const ast::Expression& expression);
  // Records that an instance is called, or passed by reference.
  void note_call(const ast::Expression& expression);
  void note_address(const ast::Expression& expression);
  void warn_about_exactness(const Place& at, const Type& type, const ast::Expression& a, const ast::Expression& b);
  static ast::Expression& make_truth(ast::Expression& expression);
  bool writable(const ast::Expression& expression);
  bool array_initial(ast::Initial& initial, const Type& type);
  bool struct_initial(ast::Initial& initial, const Type& type);

  Context& context_;
  bool reading_ = true;    // names count as read
  bool following_ = true;  // a REFERENCE TO is replaced by the variable it refers to
};

// Gives an untyped constant the type if it fits. Returns true if the value can be used as a `to` afterwards.
bool adapt(ast::Expression& expression, const Type& to);
// Converts a literal of one character to the CHAR or WCHAR that is required; returns whether it did.
bool adapt_character(ast::Expression& expression, const Type& to);
// Returns the known value of a checked expression, or null.
[[nodiscard]] const Constant* constant_of(const ast::Expression& expression) noexcept;

}  // namespace indurop::plc
