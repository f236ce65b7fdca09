// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/pou_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/check/generic_functions.h"
#include "control/plc/check/global_table.h"
#include "control/plc/check/instance_contents.h"
#include "control/plc/check/late_value.h"
#include "control/plc/check/located_variables.h"
#include "control/plc/check/object_checker.h"
#include "control/plc/check/statement_checker.h"
#include "control/plc/check/type_builder.h"
#include "control/plc/check/usage_checker.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

using ast::Section;

const Type& innermost(const Type& type) noexcept {
  const bool inside = type.kind == Type::Kind::Array || (type.kind == Type::Kind::Pointer && type.element != nullptr);
  return inside ? innermost(*type.element) : type;
}

const Type& innermost_array(const Type& type) noexcept {
  return type.kind == Type::Kind::Pointer && type.element != nullptr ? innermost_array(*type.element) : type;
}

// Returns the POU whose variables are contained in one of the type.
const Pou* held(const Type& type) noexcept {
  return type.kind == Type::Kind::Array ? held(*type.element) : type.kind == Type::Kind::Block ? type.pou : nullptr;
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
    if (type == nullptr || !count_fields(context_, declared.at, *type)) {
      remember(declared, nullptr);  // known, so that its uses are no further errors
      return;
    }
    const std::size_t before = context_.diagnostics.errors();
    set_late_value(context_, declared, *type, pou_);
    check_kind(declared, *type);
    Variable* made = remember(declared, type);
    if (made == nullptr || context_.diagnostics.errors() != before) {
      return;
    }
    if (declared.section == Section::External) {
      made->global = external_global(context_, declared, *type);
    } else if (declared.address && declared.address->numbers.empty() && !pou_.is_block()) {
      made->global = declare_placeless(context_, declared, *type);
    } else if (declared.address && !declared.address->numbers.empty()) {
      made->global = &declare_located(context_, declared, *type);
    } else if (declared.initial && holds_instances(*type)) {
      context_.open_initials.push_back({&*declared.initial, type, &pou_});
    } else if (declared.initial && expressions_.initials().initial(*declared.initial, *type) && declared.constant &&
               declared.section == Section::Local) {  // VAR_INPUT CONSTANT is passed by the caller
      remember_constant(*made, declared);
    }
    if (context_.diagnostics.errors() == before) {
      static_cast<void>(count_values(context_, declared.at, *type, declared.initial ? &*declared.initial : nullptr));
    }
    use_types(*type);
  }

  // Records the types that a variable, or the result, uses.
  void use_types(const Type& type) {
    if (const Pou* used = innermost(type).pou) {
      pou_.uses.insert(used);
    }
    if (const Pou* one = held(type)) {
      pou_.holds.insert(one);
    }
  }

 private:
  void check_instance(const ast::Variable& declared, const Type& type) {
    const Pou* held_one = held(type);
    if (held_one != nullptr && held_one->tree->is_abstract && declared.section != Section::InOut &&
        declared.section != Section::External) {
      context_.error(declared.at, abstract_instance(*held_one));
    }
    const bool has_memory =
        !pou_.is_callable() || declared.is_static || declared.of_instance || context_.codesys();  // lasts for this call
    const bool given = declared.section == Section::Input || declared.section == Section::InOut;
    if (!has_memory && !given && declared.section != Section::External) {
      context_.error(declared.at, pou_.owner != nullptr
                                      ? "a METHOD has no memory for function blocks, declare the instance as VAR_INST"
                                      : "a FUNCTION has no memory for function blocks, make it a FUNCTION_BLOCK");
    }
  }

  void check_kind(const ast::Variable& declared, const Type& type) {
    const bool is_block = holds_instances(type);
    if (is_block) {
      check_instance(declared, type);
    }
    const bool given = declared.section == Section::InOut && pou_.tree->kind != ast::Pou::Kind::Program;
    if (innermost_array(type).open && !(given && type.open)) {
      context_.error(declared.at, kOpenArray);
    }
    if (declared.of_instance && pou_.owner == nullptr) {
      context_.error(declared.at, "VAR_INST is for methods, use VAR");
    }
    if (is_block && declared.constant) {
      context_.error(declared.at, "an instance of a function block cannot be CONSTANT");
    }
    check_memory(declared, type);
    if (declared.edge != ast::Edge::None &&
        (!type.is(Elementary::Bool) || declared.section != Section::Input || pou_.is_callable())) {
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

  // Checks RETAIN, and AT %I* in function blocks: a shared variable for each instance.
  void check_memory(const ast::Variable& declared, const Type& type) {
    const bool is_block = holds_instances(type);
    const bool program = pou_.tree->kind == ast::Pou::Kind::Program;
    const bool lasts = declared.section != Section::Temp && (program || (pou_.is_block() && !declared.is_static));
    if (declared.retain && !lasts) {
      context_.warning(declared.at, "RETAIN has no effect here, only in programs, function blocks and VAR_GLOBAL");
    } else if (declared.retain && !is_block && is_private(type)) {
      context_.error(declared.at, fmt::format("{} cannot be kept over a restart, remove RETAIN", with_article(type)));
    }
    const bool placeless = declared.address && declared.address->numbers.empty();
    if (placeless && pou_.is_block() &&
        (!lasts || declared.constant || declared.section == Section::InOut || is_private(type))) {
      context_.error(declared.at, fmt::format("{} is a value of each instance, so it stands in VAR, VAR_INPUT or "
                                              "VAR_OUTPUT and is no instance, pointer or UNION",
                                              ast::to_string(*declared.address)));
    }
  }

  Variable* remember(const ast::Variable& declared, const Type* type) {
    const std::string capitals = upper(declared.name);
    if (declared.name.empty()) {
      return nullptr;
    }
    const auto known = pou_.names.find(capitals);
    if (const Variable* other = known != pou_.names.end() ? known->second : nullptr) {
      context_.error(declared.at, fmt::format("'{}' is already declared at {}, rename one of them", declared.name,
                                              to_string(other->declared->at)));
      return nullptr;
    }
    if (same_name(declared.name, pou_.name) && pou_.tree->accessor != ast::Accessor::Set) {
      context_.error(declared.at, fmt::format("'{}' is the name of the POU itself, use another one", declared.name));
    }
    Variable& made = pou_.variables.emplace_back();
    made.declared = &declared;
    made.section = declared.section;
    made.name = declared.name;
    made.type = type;
    made.is_constant = declared.constant;
    made.retain = declared.retain;
    made.owner = &pou_;
    pou_.names.emplace(capitals, &made);
    return &made;
  }

  static void remember_constant(Variable& made, const ast::Variable& declared) {
    const Constant* known = declared.initial->value ? constant_of(*declared.initial->value) : nullptr;
    if (known != nullptr && made.type->kind == Type::Kind::Elementary && !made.type->is_text()) {
      made.constant = stored(*known, *made.type);
    }
  }

  Context& context_;
  Pou& pou_;
  ExpressionChecker expressions_;
};

Pou& add(Context& context, ast::Pou& tree) {
  Pou& pou = context.program.pous.emplace_back();
  pou.index = context.program.pous.size() - 1;
  pou.tree = &tree;
  pou.name = tree.name;
  return pou;
}

void add_method(Pou& owner, Pou& method) {
  owner.methods.push_back(&method);
  owner.method_names.try_emplace({method.tree->accessor, upper(method.name)}, &method);
}

void declare_methods(Context& context, Pou& pou) {
  for (ast::Pou& tree : pou.tree->methods) {
    Pou& method = add(context, tree);
    method.owner = &pou;
    add_method(pou, method);
    pou.uses.insert(&method);
    context.program.has_objects = true;
  }
}

void check_result(Context& context, const Pou& pou) {
  if (pou.result != nullptr && holds_instances(*pou.result) && !context.codesys()) {
    context.error(pou.tree->result->at, "a function block cannot be a result, use a REFERENCE TO it or an INTERFACE");
  }
  if (pou.result != nullptr && pou.result->open) {
    context.error(pou.tree->result->at, kOpenArray);
  }
}

void declare_variables_of(Context& context, Pou& pou) {
  Pou* before = std::exchange(context.pou, &pou);
  VariableDeclarer declarer(context, pou);
  if (pou.tree->result) {
    pou.result = build_type(context, *pou.tree->result);
    check_result(context, pou);
    if (pou.result != nullptr) {
      declarer.use_types(*pou.result);
    }
  }
  for (ast::Variable& one : pou.tree->variables) {
    declarer.declare(one);
  }
  context.pou = before;
}

// Checks what is known only after the variables of all function blocks are declared.
void check_instances(Context& context) {
  for (const Pou& pou : context.program.pous) {
    context.pou = nullptr;
    for (const Variable& one : pou.variables) {
      const bool own = one.type != nullptr && one.section != Section::External && one.section != Section::InOut;
      if (!own || !holds_instances(*one.type)) {
        continue;
      }
      const bool lasts = !one.declared->is_static && !one.declared->of_instance && !pou.is_callable() &&
                         one.section != Section::Temp && (one.section != Section::Input || context.codesys());
      if (!lasts && holds_places(*one.type)) {
        context.error(one.declared->at,
                      fmt::format("{} has variables AT %I* or %Q*, which only an instance in VAR of a program or "
                                  "function block, or in VAR_GLOBAL, gives a place",
                                  to_string(*one.type)));
      }
      if (const LibraryBlock* block = one.retain ? forgetful_block(*one.type) : nullptr) {
        context.warning(one.declared->at,
                        fmt::format("of {} only inputs and outputs are kept over a restart", block->name));
      }
    }
  }
}

}  // namespace

void declare_pous(Context& context) {
  for (ast::Pou& tree : context.program.project.pous) {
    // A project may replace TIME, which is a function, too.
    const bool replaces = tree.kind == ast::Pou::Kind::Function && !find_functions(tree.name).empty();
    if (elementary_named(tree.name) && !replaces) {
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
    if (is_generic(tree)) {
      context.program.generic_functions.emplace(upper(tree.name), &tree);
      continue;
    }
    Pou& pou = add(context, tree);
    context.program.pou_names.emplace(upper(tree.name), &pou);
    declare_methods(context, pou);
  }
}

void declare_variables(Context& context) {
  for (Pou& pou : context.program.pous) {
    declare_variables_of(context, pou);
  }
  check_open_initials(context);
}

Pou& declare_further(Context& context, ast::Pou& tree) {
  Pou& pou = add(context, tree);
  context.program.pou_names.emplace(upper(tree.name), &pou);
  declare_variables_of(context, pou);
  check_open_initials(context);
  return pou;
}

void declare_method(Context& context, Pou& owner, ast::Pou& tree) {
  Pou& method = add(context, tree);
  method.owner = &owner;
  add_method(owner, method);
  owner.uses.insert(&method);
  declare_variables_of(context, method);
  check_open_initials(context);
}

void check_bodies(Context& context) {
  check_instances(context);
  const auto has_body = [](const Pou& pou) {
    return pou.owner == nullptr ? pou.tree->kind != ast::Pou::Kind::Interface
                                : !pou.tree->is_abstract && pou.owner->tree->kind != ast::Pou::Kind::Interface;
  };
  std::vector<Pou*> fine;
  for (std::size_t i = 0; i < context.program.pous.size(); ++i) {  // calls may add further ones
    Pou& pou = context.program.pous[i];
    if (!has_body(pou)) {
      continue;
    }
    context.pou = &pou;
    const std::size_t before = context.diagnostics.errors();
    StatementChecker(context).body(pou.tree->body);
    if (context.diagnostics.errors() == before) {
      fine.push_back(&pou);
    }
  }
  if (context.diagnostics.failed()) {  // omitted parts might use everything
    fine.clear();
  }
  for (Pou* pou : fine) {  // methods use variables of their instances, too
    context.pou = pou;
    const bool special = pou->owner != nullptr && upper(pou->name).starts_with("FB_");  // its result is not used
    if (pou->result != nullptr && !pou->result_assigned && !special) {
      context.warning(pou->tree->at, fmt::format("the {} never gives its result, assign it: {} := ...;",
                                                 pou->owner != nullptr ? "method" : "function", pou->name));
    }
    warn_about_usage(context, *pou);
  }
  context.pou = nullptr;
  if (!context.diagnostics.failed()) {
    warn_about_uncalled(context);
  }
}

}  // namespace indurop::plc
