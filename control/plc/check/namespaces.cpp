// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/namespaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "control/plc/library/standard.h"
#include "control/plc/model/identifier.h"
#include "control/plc/model/walk.h"

namespace indurop::plc {
namespace {

using ast::Expression;

std::string joined(const std::string& space, const std::string& name) {
  return space.empty() ? name : space + "." + name;
}

// Returns "A" for "A.B", "" for "A".
std::string outer(const std::string& space) {
  const std::size_t at = space.rfind('.');
  return at == std::string::npos ? "" : space.substr(0, at);
}

bool is_of_library(const std::string& name) {
  return elementary_named(name).has_value() || find_block(name) != nullptr || !find_functions(name).empty();
}

class Names {
 public:
  explicit Names(Project& project) {
    std::map<std::string, int> same;
    each(project, [&](std::string& name, const ast::Scope& /*scope*/) { ++same[upper(name)]; });
    each(project, [&](std::string& name, const ast::Scope& scope) {
      std::string own = name;
      if (!scope.space.empty() && (same[upper(name)] > 1 || is_of_library(name))) {
        own = joined(scope.space, name);
        std::replace(own.begin(), own.end(), '.', '_');
        while (same.contains(upper(own)) || taken_.contains(upper(own))) {
          own += "_1";
        }
      }
      taken_.insert(upper(own));
      if (!known_.emplace(upper(joined(scope.space, name)), own).second) {
        own = name;  // a duplicate, for the checker to find
      }
      for (std::string space = scope.space; !space.empty(); space = outer(space)) {
        spaces_.insert(upper(space));
      }
      if (!scope.space.empty()) {
        inside_.emplace(upper(name), joined(scope.space, name));
      }
      name = std::move(own);
    });
    for (const ast::TypeDeclaration& one : project.types) {
      if (one.type.kind == ast::TypeSpec::Kind::Enum) {
        enums_.insert(upper(one.name));
      }
    }
  }

  [[nodiscard]] bool is_enumeration(const std::string& own_name) const { return enums_.contains(upper(own_name)); }
  [[nodiscard]] bool is_space(const std::string& path) const { return spaces_.contains(upper(path)); }

  // Returns the meaning of a path in this scope; null if it is not an item of the project.
  [[nodiscard]] const std::string* find(const std::string& path, const ast::Scope& scope) const {
    for (std::string space = scope.space;; space = outer(space)) {
      if (const auto found = known_.find(upper(joined(space, path))); found != known_.end()) {
        return &found->second;
      }
      if (space.empty()) {
        break;
      }
    }
    for (const ast::NameAt& used : scope.uses) {
      if (const auto found = known_.find(upper(joined(used.name, path))); found != known_.end()) {
        return &found->second;
      }
    }
    return nullptr;
  }
  // Returns "Space.F" for an F that needs the namespace in front; "" if there is none.
  [[nodiscard]] std::string hidden(const std::string& name) const {
    const auto found = inside_.find(upper(name));
    return found == inside_.end() ? "" : found->second;
  }

 private:
  template <class Visit>
  static void each(Project& project, Visit visit) {
    for (ast::TypeDeclaration& one : project.types) {
      visit(one.name, one.scope);
    }
    for (ast::Pou& one : project.pous) {
      visit(one.name, one.scope);
    }
  }

  std::map<std::string, std::string> known_;   // unique name by "SPACE.F"
  std::map<std::string, std::string> inside_;  // "F" to "Space.F"
  std::set<std::string> spaces_;
  std::set<std::string> enums_;
  std::set<std::string> taken_;
};

// Replaces references by the unique names.
class Resolver {
 public:
  Resolver(const Names& names, Diagnostics& diagnostics) : names_(names), diagnostics_(diagnostics) {}

  void pou(ast::Pou& pou, const ast::Scope& scope) {
    scope_ = &scope;
    for (const ast::NameAt& used : scope.uses) {
      if (!names_.is_space(used.name)) {
        diagnostics_.error(used.at, fmt::format("there is no NAMESPACE '{}'", used.name));
      }
    }
    const std::set<std::string> before = variables_;
    for (const ast::Variable& one : pou.variables) {
      variables_.insert(upper(one.name));
    }
    for (std::vector<ast::NameAt>* list : {&pou.bases, &pou.interfaces}) {
      for (ast::NameAt& one : *list) {
        name(one.name, one.at);
      }
    }
    if (pou.result) {
      type(*pou.result);
    }
    variables(pou.variables);
    ast::each_expression(pou.body, [this](Expression& one) { expression(one); });
    for (ast::Pou& method : pou.methods) {
      this->pou(method, scope);
    }
    variables_ = before;
  }

  void declaration(ast::TypeDeclaration& one) {
    scope_ = &one.scope;
    type(one.type);
    initial(one.initial);
  }

  void globals(std::vector<ast::Variable>& list) {
    scope_ = &nowhere_;
    variables(list);
  }

  void instance(ProgramInstance& one) {
    scope_ = &nowhere_;
    name(one.type, one.at);
  }

 private:
  void name(std::string& path, const Place& at) {
    if (const std::string* found = names_.find(path, *scope_)) {
      path = *found;
    } else if (const std::string full = names_.hidden(path); !full.empty() && !is_of_library(path)) {
      diagnostics_.error(at, fmt::format("'{0}' is in a NAMESPACE, write {1}, or USING {2};", path, full, outer(full)));
    }
  }

  void type(ast::TypeSpec& spec) {
    if (spec.kind == ast::TypeSpec::Kind::Named) {
      name(spec.name, spec.at);
    }
    if (spec.element) {
      type(*spec.element);
    }
    const auto each = [this](Expression& one) { expression(one); };
    for (ast::Dimension& one : spec.dimensions) {
      ast::each_expression(one.low, each);
      ast::each_expression(one.high, each);
    }
    variables(spec.fields);
  }

  void variables(std::vector<ast::Variable>& list) {
    for (ast::Variable& one : list) {
      type(one.type);
      initial(one.initial);
    }
  }

  void initial(std::optional<ast::Initial>& one) {
    if (one) {
      ast::each_expression(*one, [this](Expression& each) { expression(each); });
    }
  }

  // Resolves Space.F, Space.Color.Red: the part of it that is a name of the project. Inner parts come after the outer
  // ones.
  void expression(Expression& one) {
    if (one.kind == Expression::Kind::Name && !one.value_enum.empty()) {
      name(one.value_enum, one.at);
      return;
    }
    if (one.kind == Expression::Kind::Call && one.operands[0].kind == Expression::Kind::Name &&
        !variables_.contains(upper(one.operands[0].name))) {
      name(one.operands[0].name, one.operands[0].at);
      return;
    }
    if (is_enumeration(one)) {
      return;
    }
    const std::string path = ast::path_of(one);
    if (path.empty() || variables_.contains(upper(path.substr(0, path.find('.'))))) {
      return;
    }
    if (const std::string* found = names_.find(path, *scope_)) {
      if (variables_.contains(upper(*found))) {
        diagnostics_.error(one.at, fmt::format("'{}' and the variable '{}' cannot be distinguished here, rename the "
                                               "variable",
                                               path, *found));
      }
      Expression made;
      made.kind = Expression::Kind::Name;
      made.at = one.at;
      made.name = *found;
      one = std::move(made);
    }
  }

  // Space.Color.Red becomes Color#Red, which a variable called Color does not hide.
  bool is_enumeration(Expression& one) const {
    const std::string path = one.kind == Expression::Kind::Member ? ast::path_of(one.operands[0]) : "";
    if (path.find('.') == std::string::npos || variables_.contains(upper(path.substr(0, path.find('.'))))) {
      return false;
    }
    const std::string* found = names_.find(path, *scope_);
    if (found == nullptr || !names_.is_enumeration(*found)) {
      return false;
    }
    Expression made;
    made.kind = Expression::Kind::Name;
    made.at = one.at;
    made.value_enum = *found;
    made.name = std::move(one.name);
    one = std::move(made);
    return true;
  }

  const Names& names_;
  Diagnostics& diagnostics_;
  const ast::Scope nowhere_;
  const ast::Scope* scope_ = &nowhere_;
  std::set<std::string> variables_;  // variables of the POU
};

}  // namespace

void resolve_namespaces(Project& project, Diagnostics& diagnostics) {
  const auto in_one = [](const auto& one) { return !one.scope.space.empty() || !one.scope.uses.empty(); };
  if (std::none_of(project.types.begin(), project.types.end(), in_one) &&
      std::none_of(project.pous.begin(), project.pous.end(), in_one)) {
    return;
  }
  const Names names(project);
  Resolver resolver(names, diagnostics);
  for (ast::TypeDeclaration& one : project.types) {
    resolver.declaration(one);
  }
  for (ast::Pou& one : project.pous) {
    resolver.pou(one, one.scope);
  }
  resolver.globals(project.globals);
  for (Configuration& configuration : project.configurations) {
    resolver.globals(configuration.globals);
    for (Resource& resource : configuration.resources) {
      resolver.globals(resource.globals);
      for (ProgramInstance& one : resource.programs) {
        resolver.instance(one);
      }
    }
  }
}

}  // namespace indurop::plc
