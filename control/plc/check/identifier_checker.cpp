// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/identifier_checker.h"

#include <fmt/format.h>

#include "control/plc/model/identifier.h"

namespace indurop::plc {
namespace {

class Walk {
 public:
  explicit Walk(Context& context) : context_(context) {}

  void project(const Project& project) {
    for (const ast::TypeDeclaration& one : project.types) {
      name(one.name, one.at);
      type(one.type);
    }
    for (const ast::Pou& one : project.pous) {
      pou(one);
    }
    variables(project.globals);
    for (const Configuration& one : project.configurations) {
      variables(one.globals);
      for (const Resource& resource : one.resources) {
        variables(resource.globals);
        tasks(resource);
      }
    }
    for (const Access& one : project.accesses) {
      name(one.name, one.at);
    }
  }

 private:
  void name(const std::string& text, const Place& at) {
    const auto type = elementary_named(text);
    if (std::string why = why_no_name(text); !why.empty()) {
      context_.error(at, std::move(why));
    } else if (type && (is_num(*type) || is_bit(*type))) {  // TIME is a function, too, and CHAR is one since edition 3
      context_.error(at, fmt::format("'{}' is the name of a type and cannot be another's; use another one", text));
    }
  }

  void pou(const ast::Pou& one) {
    name(one.name, one.at);
    variables(one.variables);
    body(one.body);
    if (one.result) {
      type(*one.result);
    }
    for (const ast::Pou& method : one.methods) {
      pou(method);
    }
  }

  // No text refers to these names, so OpenPLC may have a task called "task".
  void apart(const std::string& text, const Place& at) {
    if (!is_identifier(text)) {
      name(text, at);
    }
  }

  void tasks(const Resource& resource) {
    for (const Task& one : resource.tasks) {
      apart(one.name, one.at);
    }
    for (const ProgramInstance& one : resource.programs) {
      apart(one.name, one.at);
    }
  }

  void variables(const std::vector<ast::Variable>& list) {
    for (const ast::Variable& one : list) {
      if (!one.name.empty() || !one.address) {  // AT %IX0.0 : BOOL; has none
        name(one.name, one.at);
      }
      type(one.type);
    }
  }

  void type(const ast::TypeSpec& spec) {
    for (const ast::EnumValue& one : spec.values) {
      name(one.name, one.at);
    }
    variables(spec.fields);
    if (spec.element) {
      type(*spec.element);
    }
  }

  void body(const ast::Body& list) {
    for (const ast::Statement& one : list) {
      if (one.kind == ast::Statement::Kind::Label) {
        name(one.label, one.at);
      }
    }
  }

  Context& context_;
};

}  // namespace

void check_identifiers(Context& context) {
  Walk(context).project(context.program.project);
}

}  // namespace indurop::plc
