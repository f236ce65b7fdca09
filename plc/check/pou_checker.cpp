// SPDX-License-Identifier: Apache-2.0
#include "plc/check/pou_checker.h"

#include <fmt/format.h>

#include <algorithm>

#include "plc/check/global_table.h"
#include "plc/check/statement_checker.h"
#include "plc/check/type_builder.h"
#include "plc/check/usage_checker.h"
#include "plc/library/standard.h"

namespace indurop::plc {
namespace {

using ast::Section;

const Type& innermost(const Type& type) noexcept {
  const bool inside = type.kind == Type::Kind::Array || (type.kind == Type::Kind::Pointer && type.element != nullptr);
  return inside ? innermost(*type.element) : type;
}

bool is_instance(const Type& type) noexcept {
  return type.kind == Type::Kind::Block || (type.kind == Type::Kind::Array && is_instance(*type.element));
}

class VariableDeclarer {
 public:
  VariableDeclarer(Context& context, Pou& pou) : context_(context), pou_(pou), expressions_(context) {}

  void declare(ast::Variable& declared) {
    if (declared.section == Section::Global) {
      context_.error(declared.at, "VAR_GLOBAL stands outside of POUs, move it");
      return;
    }
    const Type* type = build_type(context_, declared.type);
    if (type == nullptr) {
      remember(declared, nullptr);  // known, so that its uses are no further errors
      return;
    }
    const std::size_t before = context_.diagnostics.errors();
    check_kind(declared, *type);
    Variable* made = remember(declared, type);
    if (made == nullptr || context_.diagnostics.errors() != before) {
      return;
    }
    if (declared.section == Section::External) {
      made->global = external_global(context_, declared, *type);
    } else if (declared.address && declared.address->numbers.empty()) {
      made->global = declare_placeless(context_, declared, *type);
    } else if (declared.address) {
      made->global = &declare_located(context_, declared, *type);
    } else if (declared.initial && expressions_.initial(*declared.initial, *type) && declared.constant &&
               declared.section == Section::Local) {  // VAR_INPUT CONSTANT is given by the caller
      remember_constant(*made, declared);
    }
    if (innermost(*type).pou != nullptr) {
      pou_.uses.insert(innermost(*type).pou);
    }
  }

 private:
  void check_kind(const ast::Variable& declared, const Type& type) {
    const bool is_block = is_instance(type);
    if (is_block && pou_.tree->kind == ast::Pou::Kind::Function && declared.section != Section::InOut &&
        !declared.is_static) {
      context_.error(declared.at, "a FUNCTION has no memory for function blocks, make it a FUNCTION_BLOCK");
    }
    if (is_block && declared.constant) {
      context_.error(declared.at, "an instance of a function block cannot be CONSTANT");
    }
    if (declared.retain && is_block) {
      context_.error(declared.at, kNoRetain);
    } else if (declared.retain && pou_.tree->kind != ast::Pou::Kind::Program) {
      context_.warning(declared.at, "RETAIN has no effect here, only in programs and in VAR_GLOBAL");
    }
    if (declared.edge != ast::Edge::None && (!type.is(Elementary::Bool) || declared.section != Section::Input ||
                                             pou_.tree->kind == ast::Pou::Kind::Function)) {
      context_.error(declared.at, "R_EDGE and F_EDGE are for BOOL inputs of function blocks and programs");
    }
    if (declared.section == Section::InOut && declared.initial) {
      context_.error(declared.at, "VAR_IN_OUT has no initial value, the caller gives the variable");
    }
    if (declared.constant && !declared.initial && declared.section == Section::Local) {
      context_.error(declared.at, "a CONSTANT needs a value: name : INT := 5;");
    }
    if (pou_.tree->kind == ast::Pou::Kind::Program && declared.section == Section::InOut) {
      context_.error(declared.at, "a PROGRAM has no caller that could give a VAR_IN_OUT, use VAR_EXTERNAL");
    }
  }

  Variable* remember(const ast::Variable& declared, const Type* type) {
    const std::string capitals = upper(declared.name);
    if (declared.name.empty()) {
      return nullptr;
    }
    if (const Variable* other = pou_.find(capitals)) {
      context_.error(declared.at, fmt::format("'{}' is already declared at {}, rename one of them", declared.name,
                                              to_string(other->declared->at)));
      return nullptr;
    }
    if (same_name(declared.name, pou_.name)) {
      context_.error(declared.at, fmt::format("'{}' is the name of the POU itself, use another one", declared.name));
    }
    Variable& made = pou_.variables.emplace_back();
    made.declared = &declared;
    made.section = declared.section;
    made.name = declared.name;
    made.type = type;
    made.is_constant = declared.constant;
    made.retain = declared.retain;
    pou_.names.emplace(capitals, &made);
    return &made;
  }

  static void remember_constant(Variable& made, const ast::Variable& declared) {
    const Constant* known = declared.initial->value ? constant_of(*declared.initial->value) : nullptr;
    if (known != nullptr && made.type->kind == Type::Kind::Elementary && !made.type->is_string()) {
      made.constant = stored(*known, *made.type);
    }
  }

  Context& context_;
  Pou& pou_;
  ExpressionChecker expressions_;
};

class PouOrder {
 public:
  explicit PouOrder(Context& context) : context_(context) {}

  void visit(const Pou& pou) {
    if (std::find(open_.begin(), open_.end(), &pou) != open_.end()) {
      std::string way;
      for (auto i = std::find(open_.begin(), open_.end(), &pou); i != open_.end(); ++i) {
        way += (*i)->name + " -> ";
      }
      context_.error(pou.tree->at,
                     fmt::format("recursion is not possible: {}{}, remove one of the calls", way, pou.name));
      return;
    }
    if (!done_.insert(&pou).second) {
      return;
    }
    open_.push_back(&pou);
    for (const Pou& other : context_.program.pous) {  // in the order of the text
      if (pou.uses.contains(&other)) {
        visit(other);
      }
    }
    open_.pop_back();
    context_.program.order.push_back(&pou);
  }

 private:
  Context& context_;
  std::set<const Pou*> done_;
  std::vector<const Pou*> open_;
};

}  // namespace

void declare_pous(Context& context) {
  for (ast::Pou& tree : context.program.project.pous) {
    if (elementary_named(tree.name)) {
      context.error(tree.at, fmt::format("'{}' is a name of the standard, use another one", tree.name));
      continue;
    }
    if (find_block(tree.name) != nullptr || !find_functions(tree.name).empty()) {
      context.warning(tree.at, fmt::format("'{}' takes the place of that of the standard library", tree.name));
    }
    if (const auto known = context.program.pou_names.find(upper(tree.name)); known != context.program.pou_names.end()) {
      context.error(tree.at, fmt::format("'{}' is already declared at {}, rename one of them", tree.name,
                                         to_string(known->second->tree->at)));
      continue;
    }
    Pou& pou = context.program.pous.emplace_back();
    pou.tree = &tree;
    pou.name = tree.name;
    context.program.pou_names.emplace(upper(tree.name), &pou);
  }
}

void declare_variables(Context& context) {
  for (Pou& pou : context.program.pous) {
    context.pou = &pou;
    if (pou.tree->result) {
      pou.result = build_type(context, *pou.tree->result);
    }
    VariableDeclarer declarer(context, pou);
    for (ast::Variable& one : pou.tree->variables) {
      declarer.declare(one);
    }
  }
  context.pou = nullptr;
}

void check_bodies(Context& context) {
  for (Pou& pou : context.program.pous) {
    context.pou = &pou;
    const std::size_t before = context.diagnostics.errors();
    StatementChecker(context).body(pou.tree->body);
    if (context.diagnostics.errors() != before) {
      continue;
    }
    if (pou.result != nullptr && !pou.result_assigned) {
      context.warning(pou.tree->at,
                      fmt::format("the function never gives its result, assign it: {} := ...;", pou.name));
    }
    warn_about_usage(context, pou);
  }
  context.pou = nullptr;
}

void order_pous(Context& context) {
  PouOrder order(context);
  for (const Pou& pou : context.program.pous) {
    order.visit(pou);
  }
}

}  // namespace indurop::plc
