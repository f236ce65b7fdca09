// SPDX-License-Identifier: Apache-2.0
// Short functions that build pieces of the syntax tree, for languages that are translated to it.

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/plc/model/ast.h"

namespace indurop::plc::make {

[[nodiscard]] ast::Expression truth(const Place& at, bool value);
[[nodiscard]] ast::Expression name(const Place& at, std::string name);
[[nodiscard]] ast::Expression member(const Place& at, std::string of, std::string field);
// Wraps `inner` in an operation, at its place.
[[nodiscard]] ast::Expression wrapped(ast::Expression::Kind kind, ast::Expression inner);
[[nodiscard]] ast::Expression negation(ast::Expression of);
[[nodiscard]] ast::Expression binary(ast::Operator op, ast::Expression left, ast::Expression right);
[[nodiscard]] ast::Expression call(const Place& at, ast::Expression callee, std::vector<ast::Argument> arguments);
// Makes an argument; `name` empty: by position.
[[nodiscard]] ast::Argument argument(std::string name, ast::Expression value);

[[nodiscard]] bool is_true(const ast::Expression& expression) noexcept;             // the literal TRUE
[[nodiscard]] ast::Expression both(ast::Expression left, ast::Expression right);    // AND, shorter with TRUE
[[nodiscard]] ast::Expression either(ast::Expression left, ast::Expression right);  // OR, shorter with TRUE
// Join any number of values, at least one, by both() or either(), no deeper than later passes can handle.
[[nodiscard]] ast::Expression all_of(std::vector<ast::Expression> values);
[[nodiscard]] ast::Expression any_of(std::vector<ast::Expression> values);

[[nodiscard]] ast::Statement assign(ast::Expression target, ast::Expression value);
[[nodiscard]] ast::Statement call_statement(ast::Expression call);
[[nodiscard]] ast::Statement when(ast::Expression condition, ast::Body body);
// Jumps to `label`, or returns if it is empty; only if the condition is true.
[[nodiscard]] ast::Statement leave(const Place& at, std::string label, ast::Expression condition);
[[nodiscard]] ast::Statement label(const Place& at, std::string name);

[[nodiscard]] ast::TypeSpec type(const Place& at, Elementary elementary);
[[nodiscard]] ast::TypeSpec type(const Place& at, std::string named);
// Returns the type of the first value assigned in the text of the body.
[[nodiscard]] ast::TypeSpec inferred_type(const Place& at);
[[nodiscard]] ast::Variable variable(ast::Section section, std::string name, ast::TypeSpec type);

}  // namespace indurop::plc::make
