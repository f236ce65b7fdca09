// SPDX-License-Identifier: Apache-2.0
// All of it is generated as statements of the language, which are checked and translated like those of the user.
#include "control/plc/check/starts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "control/plc/check/pou_checker.h"
#include "control/plc/check/start_statements.h"
#include "control/plc/model/make.h"

namespace indurop::plc {
namespace {

using ast::Section;

class Starter {
 public:
  explicit Starter(Context& context) : context_(context), made_(context) {}

  void run() {
    const std::size_t count = context_.program.pous.size();
    for (std::size_t i = 0; i < count; ++i) {
      pou(context_.program.pous[i]);
    }
    find_declarations();
    for (Global& one : context_.program.globals) {
      global(one);
    }
  }

 private:
  void pou(Pou& pou) {
    for (const Variable& one : pou.variables) {
      const bool takes = !one.declared->is_static && !one.declared->of_instance && one.section != Section::InOut &&
                         one.section != Section::External && one.section != Section::Input;
      check_arguments(*one.declared, one.type, takes);
    }
    if (pou.owner != nullptr && same_name(pou.name, kInit)) {
      init(pou);
    } else if (pou.owner != nullptr && (same_name(pou.name, "FB_Exit") || same_name(pou.name, "FB_Reinit"))) {
      context_.warning(pou.tree->at, fmt::format("{} only runs where it is called: a module that stops keeps no "
                                                 "instances, and none are copied while it runs",
                                                 pou.name));
    }
    begin_of_call(pou);
    if (!pou.is_callable() && pou.tree->kind != ast::Pou::Kind::Interface && made_.needs_start(pou)) {
      start_method(pou);
    }
  }

  // Checks the arguments. `takes`: instances can have arguments at this place.
  void check_arguments(const ast::Variable& declared, const Type* declared_type, bool takes) {
    const ast::TypeSpec& spec = start::innermost(declared.type);
    if (spec.starts.empty() || declared_type == nullptr) {
      return;
    }
    const Type& type = declared_type->kind == Type::Kind::Array ? *declared_type->element : *declared_type;
    if (type.pou == nullptr || type.kind != Type::Kind::Block || find_method(*type.pou, kInit) == nullptr) {
      context_.error(spec.at, fmt::format("{} has no METHOD FB_Init that takes values; to give values to inputs write "
                                          ":= (x := 1) after the type",
                                          to_string(type)));
    } else if (!takes) {
      context_.error(spec.at, "values for FB_Init are given to instances in VAR, VAR_OUTPUT, VAR_TEMP or VAR_GLOBAL");
    }
  }

  // The FB_Init of its base runs before it.
  void init(Pou& method) {
    method.tree->access = ast::Access::Public;
    const std::vector<const Variable*> inputs = start::inputs_of(method);
    const auto flag = [&](std::size_t i) {
      return inputs.size() > i && inputs[i]->section == Section::Input && inputs[i]->type != nullptr &&
             inputs[i]->type->is(Elementary::Bool);
    };
    if (!flag(0) || !flag(1)) {
      context_.error(method.tree->at, "FB_Init begins with the inputs bInitRetains : BOOL; bInCopyCode : BOOL;");
      return;
    }
    const Pou* inherited = method.owner->base != nullptr ? find_method(*method.owner->base, kInit) : nullptr;
    if (inherited == nullptr) {
      return;
    }
    std::vector<ast::Argument> arguments;
    for (const Variable* one : start::inputs_of(*inherited)) {
      const auto own = method.names.find(upper(one->name));
      if (own == method.names.end()) {
        context_.error(method.tree->at, fmt::format("FB_Init of {} wants '{}', so this one has that input too",
                                                    inherited->owner->name, one->name));
        return;
      }
      arguments.push_back(make::argument(one->name, make::name(method.tree->at, own->second->name)));
    }
    ast::Body& body = method.tree->body;
    body.insert(body.begin(), start::run(start::super_of(method.tree->at), kInit, std::move(arguments)));
  }

  // Starts variables that are new in each call.
  void begin_of_call(Pou& pou) {
    if (pou.tree->is_abstract) {
      return;
    }
    ast::Body made;
    for (const Variable& one : pou.variables) {
      const bool own = one.section == Section::Temp ||
                       (pou.is_callable() && one.section == Section::Local && !one.declared->of_instance);
      if (own && one.declared->late) {
        made.push_back(assignment(one));
      } else if (own && !one.declared->is_static && made_.started(one.type) != nullptr) {
        made_.instances(nullptr, one, made);
      }
    }
    ast::Body& body = pou.tree->body;
    body.insert(body.begin(), std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
  }

  // Base first, so that find_method() finds the overridden method.
  void start_method(Pou& pou) {
    if (!done_.insert(&pou).second) {
      return;
    }
    const Pou* inherited = nullptr;
    if (pou.base != nullptr && made_.needs_start(*pou.base)) {
      start_method(*context_.program.pou_names.at(upper(pou.base->name)));
      inherited = find_method(*pou.base, kStart);
    }
    ast::Pou& tree = context_.program.made_functions.emplace_back();
    tree.kind = ast::Pou::Kind::Method;
    tree.at = pou.tree->at;
    tree.name = kStart;
    if (inherited != nullptr) {
      tree.body.push_back(start::run(start::super_of(tree.at), kStart, {}));
    }
    for (Variable& one : pou.variables) {
      if (!StartStatements::lasts(one)) {
        continue;
      }
      if (one.declared->late) {
        tree.body.push_back(assignment(one));
      } else if (made_.started(one.type) != nullptr) {
        made_.instances(&tree, one, tree.body);
      }
    }
    declare_method(context_, pou, tree);
    context_.program.has_objects = true;
  }

  static ast::Statement assignment(const Variable& one) {
    ast::Statement made = make::assign(make::name(one.declared->at, one.name), *one.declared->late);
    made.binds = one.type != nullptr && one.type->is_reference();
    return made;
  }

  void global(Global& global) {
    const auto known = declared_.find(upper(global.name));
    const ast::Variable* declared = known != declared_.end() ? known->second : nullptr;
    if (declared != nullptr) {
      check_arguments(*declared, global.type, true);
    }
    if (global.kind != Global::Kind::Private || made_.started(global.type) == nullptr) {
      return;
    }
    const auto& names = context_.program;
    ast::Pou& tree = context_.program.made_functions.emplace_back();
    tree.kind = ast::Pou::Kind::Function;
    tree.at = global.at;
    tree.name = "start_" + global.name;
    while (names.pou_names.contains(upper(tree.name)) || names.global_names.contains(upper(tree.name)) ||
           names.type_names.contains(upper(tree.name))) {
      tree.name += "_1";
    }
    const std::vector<ast::StartArguments> none;
    made_.elements(&tree, declared != nullptr ? start::innermost(declared->type).starts : none, *global.type,
                   make::name(global.at, global.name), tree.body);
    context_.program.starts.emplace(&global, &declare_further(context_, tree));
  }

  void find_declarations() {
    const Project& project = context_.program.project;
    const auto look = [&](const std::vector<ast::Variable>& list) {
      for (const ast::Variable& one : list) {
        declared_[upper(one.name)] = &one;
      }
    };
    look(project.globals);
    for (const Configuration& one : project.configurations) {
      look(one.globals);
      for (const Resource& resource : one.resources) {
        look(resource.globals);
      }
    }
  }

  Context& context_;
  StartStatements made_;
  std::set<const Pou*> done_;
  std::map<std::string, const ast::Variable*> declared_;  // globals, by names in capitals
};

}  // namespace

void declare_starts(Context& context) {
  Starter(context).run();
}

void use_starts(Context& context) {
  for (Pou& pou : context.program.pous) {
    for (const auto& [global, use] : pou.globals) {
      if (const auto start = context.program.starts.find(global); start != context.program.starts.end()) {
        pou.uses.insert(start->second);
      }
    }
  }
}

}  // namespace indurop::plc
