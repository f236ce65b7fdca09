// SPDX-License-Identifier: Apache-2.0
#include "control/plc/front/actions.h"

#include <set>
#include <string>
#include <utility>

#include "control/plc/model/elementary.h"
#include "control/plc/model/walk.h"

namespace indurop::plc {

void make_methods_of_actions(Project& project) {
  std::set<std::string> called;
  std::set<std::string> called_of;  // "MAIN.START", if Main is no path itself
  const ast::Visit note = [&](ast::Expression& one) {
    if (one.kind != ast::Expression::Kind::Call || one.operands[0].kind != ast::Expression::Kind::Member) {
      return;
    }
    const ast::Expression& callee = one.operands[0];
    called.insert(upper(callee.name));
    if (callee.operands[0].kind == ast::Expression::Kind::Name) {
      called_of.insert(upper(callee.operands[0].name + "." + callee.name));
    }
  };
  for (ast::Pou& pou : project.pous) {
    ast::each_expression(pou.body, note);
    for (auto* list : {&pou.methods, &pou.actions}) {
      for (ast::Pou& one : *list) {
        ast::each_expression(one.body, note);
      }
    }
  }
  for (ast::Pou& pou : project.pous) {
    for (ast::Pou& action : pou.actions) {
      const bool by_name = pou.kind == ast::Pou::Kind::Program;  // it has no other instances
      if (by_name ? called_of.contains(upper(pou.name + "." + action.name)) : called.contains(upper(action.name))) {
        action.is_action = true;
        pou.methods.push_back(std::move(action));
      }
    }
    pou.actions.clear();
  }
}

}  // namespace indurop::plc
