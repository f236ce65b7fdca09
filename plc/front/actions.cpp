// SPDX-License-Identifier: Apache-2.0
#include "plc/front/actions.h"

#include <set>
#include <string>
#include <utility>

#include "plc/model/elementary.h"
#include "plc/model/walk.h"

namespace indurop::plc {

void make_methods_of_actions(Project& project) {
  std::set<std::string> called;
  const ast::Visit note = [&](ast::Expression& one) {
    const bool behind_dot =
        one.kind == ast::Expression::Kind::Call && one.operands[0].kind == ast::Expression::Kind::Member;
    if (behind_dot) {
      called.insert(upper(one.operands[0].name));
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
      if (called.contains(upper(action.name))) {
        action.is_action = true;
        pou.methods.push_back(std::move(action));
      }
    }
    pou.actions.clear();
  }
}

}  // namespace indurop::plc
