// SPDX-License-Identifier: Apache-2.0
#include "plc/check/instance_structs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plc/library/standard.h"
#include "plc/model/elementary.h"

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
    std::size_t before = 0;
    do {
      before = instances_.size();
      for (const ast::TypeDeclaration& one : project.types) {
        look(one);
      }
    } while (instances_.size() != before);
  }

  [[nodiscard]] bool is_found(const ast::TypeDeclaration& one) const { return found_.contains(&one); }

  // Of what it extends first.
  [[nodiscard]] std::vector<ast::Variable> fields(const ast::TypeDeclaration& one) const {
    std::vector<ast::Variable> out;
    std::set<const ast::TypeDeclaration*> seen;
    for (const ast::TypeDeclaration* at = &one; at != nullptr && seen.insert(at).second; at = base(*at)) {
      out.insert(out.begin(), at->type.fields.begin(), at->type.fields.end());
    }
    return out;
  }

 private:
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

  void look(const ast::TypeDeclaration& one) {
    const ast::TypeSpec& spec = one.type;
    if (spec.kind != ast::TypeSpec::Kind::Struct) {
      if (holds(spec)) {  // another name, an array
        instances_.insert(upper(one.name));
      }
      return;
    }
    const ast::TypeDeclaration* from = spec.element ? base(one) : nullptr;
    const bool inherits = from != nullptr && is_found(*from);
    if (!spec.overlaps && (inherits || std::any_of(spec.fields.begin(), spec.fields.end(),
                                                   [this](const ast::Variable& field) { return holds(field.type); }))) {
      instances_.insert(upper(one.name));
      found_.insert(&one);
    }
  }

  std::map<std::string, const ast::TypeDeclaration*> types_;
  std::set<std::string> instances_;  // names of types that hold some
  std::set<const ast::TypeDeclaration*> found_;
};

// TYPE Axis : STRUCT ... END_STRUCT := (speed := 5); becomes the values of its fields.
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
    pou.variables = finder.fields(one);
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
