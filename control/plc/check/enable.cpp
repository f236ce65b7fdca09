// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/enable.h"

#include <algorithm>

#include "control/plc/model/make.h"
#include "control/plc/model/walk.h"

namespace indurop::plc {
namespace {

bool declares(const ast::Pou& pou, std::string_view name) {
  return std::any_of(pou.variables.begin(), pou.variables.end(),
                     [&](const ast::Variable& one) { return same_name(one.name, name); });
}

void declare_enable_output(ast::Pou& pou) {
  const bool own_en = declares(pou, "EN");
  bool sets = false;
  ast::each_expression(pou.body, [&](ast::Expression& one) {
    if (one.kind != ast::Expression::Kind::Name) {
      return;
    }
    sets = sets || same_name(one.name, "ENO");
    if (!own_en && same_name(one.name, "EN")) {
      one = make::truth(one.at, true);
    }
  });
  if (sets && !declares(pou, "ENO")) {
    ast::Variable made = make::variable(ast::Section::Output, "ENO", make::type(pou.at, Elementary::Bool));
    made.at = pou.at;
    ast::Initial initial;
    initial.at = pou.at;
    initial.value = make::truth(pou.at, true);
    made.initial = std::move(initial);
    pou.variables.push_back(std::move(made));
    if (pou.kind == ast::Pou::Kind::FunctionBlock) {
      ast::Statement begin = make::assign(make::name(pou.at, "ENO"), make::truth(pou.at, true));
      begin.at = pou.at;
      pou.body.insert(pou.body.begin(), std::move(begin));
    }
  }
  for (ast::Pou& method : pou.methods) {
    declare_enable_output(method);
  }
}

}  // namespace

void declare_enable_outputs(Project& project) {
  for (ast::Pou& pou : project.pous) {
    if (pou.kind != ast::Pou::Kind::Program) {
      declare_enable_output(pou);
    }
  }
}

}  // namespace indurop::plc
