// SPDX-License-Identifier: Apache-2.0
// Orders the types of a project, each after those it contains, wherever they are declared in the text.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/type_builder.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

// Collects names of the project's types that must be declared before the declaration.
void collect_names(const ast::TypeSpec& spec, std::vector<std::string>& to) {
  if (spec.kind == ast::TypeSpec::Kind::Named) {
    to.push_back(upper(spec.name));
  }
  if (spec.element && spec.kind != ast::TypeSpec::Kind::Pointer) {
    collect_names(*spec.element, to);
  }
  for (const ast::Variable& field : spec.fields) {
    collect_names(field.type, to);
  }
}

class TypeOrder {
 public:
  explicit TypeOrder(Context& context) : context_(context) {
    for (ast::TypeDeclaration& one : context.program.project.types) {
      const auto [known, is_new] = declared_.emplace(upper(one.name), &one);
      context.declared_types.insert(upper(one.name));
      if (!is_new) {
        context.error(one.at, fmt::format("the type '{}' is already declared at {}, rename one of them", one.name,
                                          to_string(known->second->at)));
      } else if (elementary_named(one.name) || find_block(one.name) != nullptr) {
        context.error(one.at, fmt::format("'{}' is a type of the standard, use another name", one.name));
        done_.insert(&one);
      }
    }
  }

  void run() {
    for (ast::TypeDeclaration& one : context_.program.project.types) {
      begin(one);
      while (!open_.empty()) {  // no recursion: there may be chains of thousands of type names
        step();
      }
    }
  }

 private:
  // A declaration that waits for those it needs.
  struct Open {
    ast::TypeDeclaration* one = nullptr;
    std::vector<std::string> needed;
    std::size_t next = 0;
  };

  void begin(ast::TypeDeclaration& one) {
    if (done_.insert(&one).second) {
      open_.push_back({&one, {}, 0});
      waiting_.insert(&one);
      collect_names(one.type, open_.back().needed);
    }
  }

  void step() {
    Open& top = open_.back();
    ast::TypeDeclaration& one = *top.one;
    while (top.next < top.needed.size()) {
      const auto found = declared_.find(top.needed[top.next++]);
      if (found == declared_.end()) {
        continue;
      }
      if (waiting_.contains(found->second)) {
        context_.error(one.at,
                       fmt::format("the type '{}' contains itself, use an array with indices instead", one.name));
        end(one);
        return;
      }
      if (!done_.contains(found->second)) {
        begin(*found->second);
        return;
      }
    }
    end(one);
    if (const Type* type = build_named(one)) {
      context_.program.type_names.emplace(upper(one.name), type);
    }
  }

  void end(const ast::TypeDeclaration& one) {
    waiting_.erase(&one);
    open_.pop_back();
  }

  const Type* build_named(ast::TypeDeclaration& one) {
    const Type* type = build_type(context_, one.type, one.name);
    if (type != nullptr && type->open) {
      context_.error(one.at, kOpenArray);
      return nullptr;
    }
    if (type == nullptr || !one.initial || !ExpressionChecker(context_).initials().initial(*one.initial, *type)) {
      return type;
    }
    // TYPE Speed : INT := 5; is a type of its own, because INT begins with 0.
    auto& named = context_.program.named_types;
    const bool is_new = !named.empty() && named.back() == type && type->name == one.name;
    Type* own = is_new ? named.back() : context_.program.types.add(*type);
    own->initial = &*one.initial;
    own->default_values.reset();
    return own;
  }

  Context& context_;
  std::map<std::string, ast::TypeDeclaration*> declared_;
  std::set<const ast::TypeDeclaration*> done_;
  std::vector<Open> open_;                         // each is needed by the previous one
  std::set<const ast::TypeDeclaration*> waiting_;  // the elements of `open_`
};

// Returns true for TYPE P : POINTER TO P; such a type has no end, and one with too many levels of pointers counts as
// one.
bool leads_to_itself(const Type& pointer) noexcept {
  const Type* at = pointer.element;
  std::size_t depth = 0;
  while (at != nullptr && at != &pointer && (at->kind == Type::Kind::Pointer || at->kind == Type::Kind::Array)) {
    if (++depth > kMaxTypeNesting) {
      return true;
    }
    at = at->element;
  }
  return at == &pointer;
}

}  // namespace

void declare_types(Context& context) {
  for (Pou& pou : context.program.pous) {
    const bool is_interface = pou.tree->kind == ast::Pou::Kind::Interface;
    if (!pou.is_block() && !is_interface) {
      continue;
    }
    Type type;
    type.kind = is_interface ? Type::Kind::Interface : Type::Kind::Block;
    type.name = pou.name;
    type.pou = &pou;
    pou.type = context.program.types.add(std::move(type));
    context.program.type_names.emplace(upper(pou.name), pou.type);
  }
  TypeOrder(context).run();
  context.program.types_known = true;
  for (const auto& [pointer, spec] : context.program.open_pointers) {
    pointer->element = build_type(context, *spec, "");
  }
  for (const auto& [pointer, spec] : context.program.open_pointers) {
    if (leads_to_itself(*pointer)) {
      context.error(spec->at, fmt::format("a pointer to '{}' leads to itself, put a STRUCT between", spec->name));
    }
    if (pointer->element == nullptr || leads_to_itself(*pointer)) {
      pointer->element = context.elementary(Elementary::Int);
    }
  }
}

}  // namespace indurop::plc
