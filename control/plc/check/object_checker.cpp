// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/object_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "control/plc/check/inheritance.h"
#include "control/plc/check/starts.h"

namespace indurop::plc {
namespace {

using ast::Section;
using PouKind = ast::Pou::Kind;

std::string_view word_of(const Pou& pou) noexcept {
  return pou.tree->kind == PouKind::Interface ? "INTERFACE"
         : pou.tree->kind == PouKind::Class   ? "CLASS"
                                              : "FUNCTION_BLOCK";
}

// Returns "METHOD Start", "GET of the PROPERTY Speed".
std::string shown(const Pou& method) {
  switch (method.tree->accessor) {
    case ast::Accessor::Get:
      return fmt::format("GET of the PROPERTY {}", method.name);
    case ast::Accessor::Set:
      return fmt::format("SET of the PROPERTY {}", method.name);
    case ast::Accessor::None:
      break;
  }
  return "METHOD " + method.name;
}

bool same_exactly(const Type* a, const Type* b) noexcept {
  return a == b || (a != nullptr && b != nullptr && same_type(*a, *b) && same_range(*a, *b));
}

// Returns the difference of two methods of which one replaces the other; "" if there is none.
std::string difference(const Pou& method, const Pou& other) {
  if (!same_exactly(method.result, other.result)) {
    return fmt::format("its result is {}", other.result != nullptr ? with_article(*other.result) : "none");
  }
  const std::vector<const Variable*>& own = parameters_of(method);
  const std::vector<const Variable*>& wanted = parameters_of(other);
  for (std::size_t i = 0; i < std::max(own.size(), wanted.size()); ++i) {
    if (i >= wanted.size()) {
      return fmt::format("it has no {}", own[i]->name);
    }
    if (i >= own.size() || !same_name(own[i]->name, wanted[i]->name) || own[i]->section != wanted[i]->section) {
      return fmt::format("its parameter {} is {}", i + 1, wanted[i]->name);
    }
    if (own[i]->type != nullptr && wanted[i]->type != nullptr && !same_exactly(own[i]->type, wanted[i]->type)) {
      return fmt::format("its parameter {} is {}", wanted[i]->name, with_article(*wanted[i]->type));
    }
  }
  return "";
}

class Declarer {
 public:
  explicit Declarer(Context& context) : context_(context) {}

  void declare(Pou& pou) {
    for (const ast::NameAt& one : pou.tree->bases) {
      base(pou, one);
    }
    for (const ast::NameAt& one : pou.tree->interfaces) {
      if (const Pou* found =
              this->find(one, "IMPLEMENTS names an INTERFACE", {PouKind::Interface, PouKind::Interface})) {
        add_interface(pou, *found, one.at);
      }
    }
  }

 private:
  const Pou* find(const ast::NameAt& at, std::string_view rule, std::array<PouKind, 2> kinds) {
    const auto found = context_.program.pou_names.find(upper(at.name));
    if (found == context_.program.pou_names.end()) {
      std::vector<std::string> known;
      for (const auto& [name, pou] : context_.program.pou_names) {
        if (pou->tree->kind == kinds[0] || pou->tree->kind == kinds[1]) {
          known.push_back(pou->name);
        }
      }
      const std::string hint = did_you_mean(context_, at.name, known);
      context_.error(at.at, fmt::format("there is no {} '{}'{}",
                                        kinds[0] == PouKind::Interface ? "INTERFACE" : "function block or class",
                                        at.name, hint.empty() ? ", declare it" : hint));
      return nullptr;
    }
    const Pou& pou = *found->second;
    if (pou.tree->kind != kinds[0] && pou.tree->kind != kinds[1]) {
      context_.error(at.at, fmt::format("{}, and {} is none", rule, pou.name));
      return nullptr;
    }
    return &pou;
  }

  void base(Pou& pou, const ast::NameAt& at) {
    if (pou.tree->kind == PouKind::Interface) {
      if (const Pou* found = find(at, "an INTERFACE extends interfaces", {PouKind::Interface, PouKind::Interface})) {
        add_interface(pou, *found, at.at);
      }
      return;
    }
    if (!pou.is_block()) {
      context_.error(at.at, "only function blocks, classes and interfaces extend others, remove this EXTENDS");
      return;
    }
    const PouKind other = pou.tree->kind == PouKind::Class ? PouKind::Class : PouKind::FunctionBlock;
    const Pou* found =
        find(at,
             pou.tree->kind == PouKind::Class ? "a CLASS extends a CLASS; of interfaces say IMPLEMENTS"
                                              : "EXTENDS names a function block or class; of interfaces say IMPLEMENTS",
             {other, PouKind::Class});
    if (found == nullptr) {
      return;
    }
    if (pou.base != nullptr) {
      context_.error(at.at, fmt::format("{} extends {} already; only one can be extended, of others declare instances",
                                        pou.name, pou.base->name));
      return;
    }
    if (found->tree->is_final) {
      context_.error(at.at,
                     fmt::format("{} is FINAL, nothing extends it; declare an instance of it instead", found->name));
    }
    pou.base = found;
    link(pou, *found);
  }

  void add_interface(Pou& pou, const Pou& interface, const Place& at) {
    if (std::find(pou.interfaces.begin(), pou.interfaces.end(), &interface) != pou.interfaces.end()) {
      context_.error(at, fmt::format("{} is named twice, remove one of them", interface.name));
      return;
    }
    pou.interfaces.push_back(&interface);
    link(pou, interface);
  }

  void link(Pou& pou, const Pou& to) {
    pou.uses.insert(&to);
    context_.program.has_objects = true;
  }

  Context& context_;
};

class ObjectChecker {
 public:
  ObjectChecker(Context& context, Pou& pou) : context_(context), pou_(pou) {}

  void check() {
    for (Pou* method : pou_.methods) {
      names(*method);
      own(*method);
      replaced(*method);
    }
    variables();
    if (pou_.is_block() && !pou_.tree->is_abstract) {
      complete();
    }
    signatures();
  }

 private:
  void names(const Pou& method) {
    for (const ast::Accessor one : {ast::Accessor::None, ast::Accessor::Get, ast::Accessor::Set}) {
      const auto known = pou_.method_names.find({one, upper(method.name)});
      const bool accessors = one != ast::Accessor::None && method.tree->accessor != ast::Accessor::None;
      if (known != pou_.method_names.end() && known->second->index < method.index &&
          (!accessors || one == method.tree->accessor)) {
        context_.error(method.tree->at, fmt::format("'{}' is already declared at {}, rename one of them", method.name,
                                                    to_string(known->second->tree->at)));
      }
    }
    if (const Variable* same = pou_.find(upper(method.name))) {
      context_.error(method.tree->at, fmt::format("'{}' is the name of the variable at {} too, rename one of them",
                                                  method.name, to_string(same->declared->at)));
    }
  }

  void own(const Pou& method) {
    const ast::Pou& tree = *method.tree;
    const bool program = pou_.tree->kind == PouKind::Program && (context_.codesys() || tree.name == kStart);
    if (!program && pou_.tree->kind != PouKind::FunctionBlock && pou_.tree->kind != PouKind::Class &&
        pou_.tree->kind != PouKind::Interface) {
      context_.error(tree.at, "only function blocks, classes and interfaces have methods, write a FUNCTION");
      return;
    }
    if (tree.is_abstract && !pou_.tree->is_abstract && pou_.is_block()) {
      context_.error(tree.at, fmt::format("{} is ABSTRACT, so {} has to be: {} ABSTRACT {}", tree.name, pou_.name,
                                          word_of(pou_), pou_.name));
    }
    const bool without_body = tree.is_abstract || pou_.tree->kind == PouKind::Interface;
    if (without_body && !tree.body.empty()) {
      context_.error(tree.body.front().at, fmt::format("{} has no statements, because it is {}", shown(method),
                                                       tree.is_abstract ? "ABSTRACT" : "of an INTERFACE"));
    }
  }

  void replaced(Pou& method) {
    if (same_name(method.name, kInit) || method.name == kStart) {
      return;  // each has its own values, and runs that of its base
    }
    const Pou* other = pou_.base != nullptr ? find_method(*pou_.base, method.name, method.tree->accessor) : nullptr;
    if (other == nullptr || other->owner->tree->kind == PouKind::Interface) {
      if (method.tree->overrides && other == nullptr) {
        context_.error(method.tree->at,
                       fmt::format("OVERRIDE, but nothing that {} extends has a {}", pou_.name, shown(method)));
      }
      return;
    }
    method.replaces = other;
    method.called_unseen = true;
    if (other->tree->access == ast::Access::Private) {
      context_.error(method.tree->at, fmt::format("{} of {} is PRIVATE and cannot be replaced, use another name",
                                                  shown(*other), other->owner->name));
    } else if (other->tree->is_final) {
      context_.error(method.tree->at, fmt::format("{} of {} is FINAL and cannot be replaced, use another name",
                                                  shown(*other), other->owner->name));
    } else if (method.tree->access > other->tree->access) {
      context_.error(method.tree->at,
                     fmt::format("fewer may call it than that of {}, give it the same access", other->owner->name));
    }
    compare(method, *other, method.tree->at);
  }

  void compare(const Pou& method, const Pou& other, const Place& at) {
    if (const std::string what = difference(method, other); !what.empty()) {
      context_.error(at, fmt::format("{} is not that of {} that it stands for: there {}; declare both alike",
                                     shown(method), other.owner->name, what));
    }
  }

  // Checks that the variables of an instance, including inherited ones, have different names.
  void variables() {
    for (const Variable& one : pou_.variables) {
      if (pou_.base == nullptr) {
        break;
      }
      if (const Variable* same = pou_.base->find(upper(one.name))) {
        context_.error(one.declared->at,
                       fmt::format("'{}' is inherited from {}, rename one of them", one.name, same->owner->name));
      } else if (find_method(*pou_.base, one.name) != nullptr ||
                 find_method(*pou_.base, one.name, ast::Accessor::Get) != nullptr ||
                 find_method(*pou_.base, one.name, ast::Accessor::Set) != nullptr) {
        context_.error(one.declared->at,
                       fmt::format("'{}' is inherited from {}, rename one of them", one.name, pou_.base->name));
      }
    }
  }

  // Returns all methods that its interfaces require.
  std::vector<const Pou*> wanted() const {
    std::vector<const Pou*> out;
    for (const Pou* one : pou_.ancestors) {
      if (one->tree->kind == PouKind::Interface) {
        out.insert(out.end(), one->methods.begin(), one->methods.end());
      }
    }
    return out;
  }

  // Reports all missing methods in one error.
  void complete() {
    constexpr std::size_t kShown = 100;
    std::string missing;
    std::set<std::string> known;
    const auto miss = [&](const Pou& one) {
      const std::string text = fmt::format("{} of {}", shown(one), one.owner->name);
      if (known.size() <= kShown && known.insert(text).second) {
        missing += (missing.empty() ? "" : ", ") + (known.size() <= kShown ? text : "...");
      }
    };
    for (const Pou* one : wanted()) {
      if (find_method(pou_, one->name, one->tree->accessor) == nullptr) {
        miss(*one);
      }
    }
    for (const Pou* at = pou_.base; at != nullptr; at = at->base) {
      for (const Pou* one : at->methods) {
        const Pou* found = find_method(pou_, one->name, one->tree->accessor);
        if (found != nullptr && found->tree->is_abstract) {
          miss(*one);
        }
      }
    }
    if (!missing.empty()) {
      context_.error(pou_.tree->at, fmt::format("{} does not have the {}; write it, or declare {} as ABSTRACT",
                                                pou_.name, missing, pou_.name));
    }
  }

  // Checks that methods required by an interface have its signature and are PUBLIC.
  void signatures() {
    for (const Pou* one : wanted()) {
      const Pou* found = find_method(pou_, one->name, one->tree->accessor);
      const bool compared =
          found != nullptr && found->replaces != nullptr && found->owner == &pou_ && is_a(*pou_.base, *one->owner);
      if (found == nullptr || found->owner->tree->kind == PouKind::Interface || compared) {
        continue;
      }
      const Place& at = found->owner == &pou_ ? found->tree->at : pou_.tree->at;
      compare(*found, *one, at);
      if (found->tree->access > ast::Access::Internal) {
        context_.error(at, fmt::format("{} is of {}, which everybody may call, declare it as PUBLIC", shown(*found),
                                       one->owner->name));
      }
      found->owner->method_names.at({found->tree->accessor, upper(found->name)})->called_unseen = true;
    }
  }

  Context& context_;
  Pou& pou_;
};

}  // namespace

void declare_objects(Context& context) {
  Declarer declarer(context);
  for (Pou& pou : context.program.pous) {
    declarer.declare(pou);
  }
  resolve_inheritance(context);
  for (Pou& pou : context.program.pous) {
    if (pou.base != nullptr) {
      pou.holds.insert(pou.base);
    }
    pou.holds.insert(pou.interfaces.begin(), pou.interfaces.end());
    pou.is_object = pou.is_object || !pou.methods.empty() || pou.base != nullptr || !pou.interfaces.empty() ||
                    pou.tree->is_abstract || pou.tree->kind == PouKind::Class;
    if (pou.base != nullptr) {
      context.program.pou_names.at(upper(pou.base->name))->is_object = true;
    }
  }
}

void check_objects(Context& context) {
  for (Pou& pou : context.program.pous) {
    if (pou.owner == nullptr) {
      context.pou = nullptr;
      ObjectChecker(context, pou).check();
    }
  }
}

std::string abstract_instance(const Pou& pou) {
  return fmt::format(
      "{0} is ABSTRACT and has no instances; declare one of a function block that extends {0}, or a "
      "REFERENCE TO it",
      pou.name);
}

}  // namespace indurop::plc
