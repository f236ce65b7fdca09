// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/instance_structs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "control/plc/library/standard.h"
#include "control/plc/model/elementary.h"

namespace indurop::plc {
namespace {

class Finder {
 public:
  explicit Finder(const Project& project) {
    for (const ast::Pou& one : project.pous) {
      if (one.kind == ast::Pou::Kind::FunctionBlock || one.kind == ast::Pou::Kind::Class) {
        instances_.insert(upper(one.name));
      }
    }
    for (const ast::TypeDeclaration& one : project.types) {
      types_.emplace(upper(one.name), &one);
    }
    std::map<std::string, std::vector<const ast::TypeDeclaration*>> users;
    std::vector<const ast::TypeDeclaration*> open;
    for (const ast::TypeDeclaration& one : project.types) {
      open.push_back(&one);
      each_name(one.type, [&](const std::string& name) { users[name].push_back(&one); });
    }
    while (!open.empty()) {  // types that contain a found one are checked again
      const std::string name = upper(open.back()->name);
      const bool is_new = look(*open.back());
      open.pop_back();
      if (const auto found = users.find(name); is_new && found != users.end()) {
        open.insert(open.end(), found->second.begin(), found->second.end());
      }
    }
  }

  [[nodiscard]] bool is_found(const ast::TypeDeclaration& one) const { return found_.contains(&one); }

  // Returns the fields, those of its base first.
  [[nodiscard]] std::vector<ast::Variable> fields(const ast::TypeDeclaration& one, Diagnostics& diagnostics) const {
    std::vector<const ast::TypeDeclaration*> way;
    std::set<const ast::TypeDeclaration*> seen;
    for (const ast::TypeDeclaration* at = &one; at != nullptr && seen.insert(at).second; at = base(*at)) {
      way.push_back(at);
      if (way.size() > kMaxExtends) {
        diagnostics.error(one.at,
                          fmt::format("more than {} structures that extend each other, use fewer", kMaxExtends));
        break;
      }
    }
    std::vector<ast::Variable> out;
    for (auto at = way.rbegin(); at != way.rend(); ++at) {
      out.insert(out.end(), (*at)->type.fields.begin(), (*at)->type.fields.end());
    }
    return out;
  }

 private:
  // Visits the names of types whose instances are contained in one of the type.
  template <class Visit>
  static void each_name(const ast::TypeSpec& spec, Visit visit) {
    if (spec.kind == ast::TypeSpec::Kind::Named) {
      visit(upper(spec.name));
    }
    if (spec.element && spec.kind != ast::TypeSpec::Kind::Pointer) {
      each_name(*spec.element, visit);
    }
    for (const ast::Variable& field : spec.fields) {
      each_name(field.type, visit);
    }
  }

  [[nodiscard]] const ast::TypeDeclaration* base(const ast::TypeDeclaration& one) const {
    const auto found = one.type.element ? types_.find(upper(one.type.element->name)) : types_.end();
    return found != types_.end() ? found->second : nullptr;
  }

  [[nodiscard]] bool holds(const ast::TypeSpec& spec) const {
    if (spec.kind == ast::TypeSpec::Kind::Array) {
      return holds(*spec.element);
    }
    const std::string name = upper(spec.name);
    return spec.kind == ast::TypeSpec::Kind::Named &&
           (instances_.contains(name) || (!types_.contains(name) && find_block(spec.name) != nullptr));
  }

  // Returns whether the type is now, for the first time, known to hold instances.
  bool look(const ast::TypeDeclaration& one) {
    const ast::TypeSpec& spec = one.type;
    if (spec.kind != ast::TypeSpec::Kind::Struct) {
      return holds(spec) && instances_.insert(upper(one.name)).second;  // another name, an array
    }
    const ast::TypeDeclaration* from = spec.element ? base(one) : nullptr;
    const bool inherits = from != nullptr && is_found(*from);
    if (!spec.overlaps && (inherits || std::any_of(spec.fields.begin(), spec.fields.end(),
                                                   [this](const ast::Variable& field) { return holds(field.type); }))) {
      const bool by_name = instances_.insert(upper(one.name)).second;
      return found_.insert(&one).second || by_name;
    }
    return false;
  }

  std::map<std::string, const ast::TypeDeclaration*> types_;
  std::set<std::string> instances_;  // names of types that hold instances
  std::set<const ast::TypeDeclaration*> found_;
};

// Applies the values of TYPE Axis : STRUCT ... END_STRUCT := (speed := 5); to the fields.
void begin_with(std::vector<ast::Variable>& fields, ast::TypeDeclaration& from, Diagnostics& diagnostics) {
  if (!from.initial) {
    return;
  }
  for (ast::InitialElement& one : from.initial->elements) {
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [&](const ast::Variable& each) { return same_name(each.name, one.field); });
    if (field == fields.end()) {
      diagnostics.error(one.value.at, fmt::format("{} has no field '{}' to begin with", from.name, one.field));
    } else {
      field->initial = std::move(one.value);
    }
  }
}

}  // namespace

void make_instance_structs(Project& project, Diagnostics& diagnostics) {
  const Finder finder(project);
  for (ast::TypeDeclaration& one : project.types) {
    if (!finder.is_found(one)) {
      continue;
    }
    ast::Pou& pou = project.pous.emplace_back();
    pou.kind = ast::Pou::Kind::Class;
    pou.is_struct = true;
    pou.at = one.at;
    pou.name = one.name;
    pou.comment = one.comment;
    pou.scope = one.scope;
    pou.variables = finder.fields(one, diagnostics);
    begin_with(pou.variables, one, diagnostics);
    for (ast::Variable& field : pou.variables) {
      field.section = ast::Section::Local;
      field.access = ast::Access::Public;
    }
  }
  std::vector<ast::TypeDeclaration> others;
  for (ast::TypeDeclaration& one : project.types) {
    if (!finder.is_found(one)) {
      others.push_back(std::move(one));
    }
  }
  project.types = std::move(others);
}

}  // namespace indurop::plc
