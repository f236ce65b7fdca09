// SPDX-License-Identifier: Apache-2.0
// Names and constants as visible from the place that is checked.

#include "glb2idl/context.h"

#include <fmt/format.h>

#include "core/base/nearest.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {

std::string Context::source(const ast::Name& name) const {
  const std::string& path = sources.file(file).path;
  return fmt::format("{}:{}", path.substr(path.rfind('/') + 1), sources.line_of(name.at));
}

bool Context::check_name(const ast::Name& name, NameRole role) {
  const bool inner = role == NameRole::Field || role == NameRole::Parameter;
  const bool global = !inner && current.empty();
  const auto why = objection(name.text, role, global);
  if (!why) {
    return true;
  }
  error(name.at,
        fmt::format("'{}' {}, choose another name such as '{}'{}", name.text, *why, proposal(name.text, role, global),
                    global && !objection(name.text, role, false) ? " or a namespace" : ""));
  return false;
}

bool Context::declare(const ast::Name& name, Symbol::Kind kind) {
  Symbol symbol;
  symbol.kind = kind;
  symbol.at = name.at;
  return scope.declare(full(name.text), std::move(symbol));
}

std::optional<Value> Context::constant(const ast::Path& path) {
  const Symbol* found = scope.find(current, path.parts, file);
  if (found == nullptr && path.parts.size() == 1) {
    found = scope.find_define(path.parts[0], file);
  }
  if (found != nullptr && found->kind == Symbol::Kind::Constant) {
    return found->value;
  }
  const std::string shown = join_names(path.parts, "::");
  if (found != nullptr && found->kind != Symbol::Kind::Broken) {
    error(path.at, fmt::format("'{}' is not a constant, only constants and numbers have a value here", shown));
  } else if (found == nullptr && !is_broken(path)) {
    const std::string near =
        diagnostics.full() ? "" : base::nearest(path.parts.back(), scope.names(Symbol::Kind::Constant, file));
    error(path.at, near.empty() ? fmt::format("'{}' is not known here, declare it above with #define or const", shown)
                                : fmt::format("'{}' is not known here, did you mean '{}'?", shown, near));
  }
  return std::nullopt;
}

std::optional<Value> Context::evaluate(const ast::Expression& expression) {
  return glb2idl::evaluate(
      expression, [this](const ast::Path& path) { return constant(path); }, diagnostics);
}

}  // namespace indurop::glb2idl
