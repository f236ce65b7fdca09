// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/context.h"

#include <fmt/format.h>

#include "core/base/nearest.h"

namespace indurop::plc {

std::string did_you_mean(const Context& context, std::string_view name, const std::vector<std::string>& known) {
  if (context.diagnostics.full()) {
    return "";
  }
  const std::string found = base::nearest(name, known);
  return found.empty() ? "" : ", did you mean '" + found + "'?";
}

void complain_undeclared(Context& context, const Place& at, const std::string& name) {
  const std::string capitals = upper(name);
  if (context.known_errors.contains({nullptr, capitals}) ||
      !context.known_errors.insert({context.pou, capitals}).second) {
    return;
  }
  if (context.diagnostics.full()) {  // further errors are only counted
    context.error(at, fmt::format("'{}' is not declared", name));
    return;
  }
  std::vector<std::string> known;
  if (context.pou != nullptr) {
    for (const Variable& variable : context.pou->variables) {
      known.push_back(variable.name);
    }
  }
  for (const Global& one : context.program.globals) {
    known.push_back(one.name);
  }
  const std::string hint = did_you_mean(context, name, known);
  context.error(
      at, fmt::format("'{}' is not declared{}", name, hint.empty() ? ", declare it between VAR and END_VAR" : hint));
}

}  // namespace indurop::plc
