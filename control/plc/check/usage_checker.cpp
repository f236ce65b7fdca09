// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/usage_checker.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::plc {
namespace {

using ast::Section;

// Returns true for instances that do something when they are called.
bool is_instance(const Type& type) noexcept {
  const bool has_body = type.pou == nullptr || type.pou->tree->kind != ast::Pou::Kind::Class;
  return (type.kind == Type::Kind::Block && has_body) || (type.kind == Type::Kind::Array && is_instance(*type.element));
}

void warn_about(Context& context, const Pou& pou, const Variable& variable) {
  if (variable.declared->access == ast::Access::Public) {  // others use it
    return;
  }
  const bool own =
      variable.section == Section::Local || variable.section == Section::Temp || variable.section == Section::External;
  const Place& at = variable.declared->at;
  if (own && !variable.used && !variable.declared->address && !variable.retain) {
    context.warning(at, fmt::format("'{}' is never used", variable.name));
  } else if (own && variable.type != nullptr && is_instance(*variable.type) && variable.global == nullptr &&
             !variable.called && !variable.retain) {
    context.warning(
        at, fmt::format("'{0}' is never called, so its outputs never change; call it: {0}(...);", variable.name));
  } else if (variable.section == Section::Output && !variable.written && variable.global == nullptr &&
             !variable.declared->initial && pou.tree->kind != ast::Pou::Kind::Program) {
    context.warning(at, fmt::format("the output '{}' is never written", variable.name));
  }
}

}  // namespace

void warn_about_usage(Context& context, const Pou& pou) {
  for (const Variable& variable : pou.variables) {
    warn_about(context, pou, variable);
  }
  const bool empty = std::all_of(pou.tree->body.begin(), pou.tree->body.end(),
                                 [](const ast::Statement& one) { return one.kind == ast::Statement::Kind::Empty; });
  if (empty && pou.tree->kind != ast::Pou::Kind::Class && pou.result == nullptr && !pou.is_object &&
      pou.owner == nullptr && context.diagnostics.errors() == 0) {  // after an error it may only seem unused
    context.warning(pou.tree->at, "the body is empty");
  }
}

}  // namespace indurop::plc
