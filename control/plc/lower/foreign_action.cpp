// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/foreign_action.h"

#include <algorithm>

#include "control/plc/model/elementary.h"

namespace indurop::plc::lower {
namespace {

const ast::Pou* pou_named(const Project& project, std::string_view name) {
  const auto found = std::find_if(project.pous.begin(), project.pous.end(),
                                  [&](const ast::Pou& one) { return same_name(one.name, name); });
  return found == project.pous.end() ? nullptr : &*found;
}

struct Found {
  const ast::Variable* variable = nullptr;
  bool sure = true;  // false: a base is not in the project
};

// Finds inherited variables, too.
Found variable_of(const Project& project, const ast::Pou& pou, std::string_view name) {
  const ast::Pou* at = &pou;
  constexpr int kMostBases = 64;
  for (int i = 0; i < kMostBases; ++i) {
    const auto found = std::find_if(at->variables.begin(), at->variables.end(),
                                    [&](const ast::Variable& one) { return same_name(one.name, name); });
    if (found != at->variables.end()) {
      return {&*found, true};
    }
    if (at->bases.empty()) {
      return {};
    }
    at = pou_named(project, at->bases.front().name);
    if (at == nullptr) {
      break;
    }
  }
  return {nullptr, false};
}

}  // namespace

bool names_foreign_action(const Project& project, const ast::Pou& pou, std::string_view name) {
  const ast::Pou* at = &pou;
  for (std::size_t dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.')) {
    const Found instance = variable_of(project, *at, name.substr(0, dot));
    if (instance.variable == nullptr || instance.variable->type.kind != ast::TypeSpec::Kind::Named) {
      return false;
    }
    at = pou_named(project, instance.variable->type.name);
    if (at == nullptr) {
      return false;
    }
    name.remove_prefix(dot + 1);
  }
  const Found last = variable_of(project, *at, name);
  return at != &pou && at->kind == ast::Pou::Kind::FunctionBlock && last.variable == nullptr && last.sure;
}

}  // namespace indurop::plc::lower
