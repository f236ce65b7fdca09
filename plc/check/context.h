// SPDX-License-Identifier: Apache-2.0
// What the parts of the checker share while they go through a project.

#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plc/check/program.h"
#include "plc/model/diagnostics.h"

namespace indurop::plc {

// Of a variable of `pou`, null: a global.
struct OpenInitial {
  ast::Initial* initial = nullptr;
  const Type* type = nullptr;
  Pou* pou = nullptr;
};

struct Context {
  Program& program;
  Diagnostics& diagnostics;
  Pou* pou = nullptr;  // the one being checked
  // The variables of the FOR statements around: a Variable or a Global, and where the loop stands.
  std::vector<std::pair<const void*, Place>> loop_variables{};
  // Names whose declaration has an error, or that a POU uses and nobody declares: said once. Globals: of no POU.
  std::set<std::pair<const Pou*, std::string>> known_errors{};
  // Initial values of instances, wherever their function blocks stand: looked at when all variables are known.
  std::vector<OpenInitial> open_initials{};
  // In capitals, those that begin with errors too.
  std::set<std::string> declared_types{};
  // The last number that a name for types without one ended in.
  std::map<std::string, std::size_t> type_numbers{};

  void error(const Place& at, std::string text) { diagnostics.error(at, located(std::move(text))); }
  void warning(const Place& at, std::string text) { diagnostics.warning(at, located(std::move(text))); }

  [[nodiscard]] const Type* elementary(Elementary type) const { return program.types.elementary(type); }

  [[nodiscard]] bool codesys() const noexcept { return program.project.dialect == Dialect::Codesys; }
  [[nodiscard]] bool assignable(const Type& from, const Type& to) const noexcept {
    return plc::assignable(from, to, program.project.dialect);
  }
  [[nodiscard]] const Type* common_type(const Type& a, const Type& b) const noexcept {
    return plc::common_type(a, b, program.project.dialect);
  }

 private:
  // Errors of texts name the POU too.
  [[nodiscard]] std::string located(std::string text) const {
    return pou != nullptr ? pou->title() + ": " + text : std::move(text);
  }
};

// Nobody declares the name; said once in a POU, and never of a global whose declaration has an error.
void complain_undeclared(Context& context, const Place& at, const std::string& name);

// ", did you mean 'x'?" for the nearest of `known`, or "". Not looked for any more when no error is kept: in thousands
// of names thousands of times it takes longer than all the rest.
[[nodiscard]] std::string did_you_mean(const Context& context, std::string_view name,
                                       const std::vector<std::string>& known);

}  // namespace indurop::plc
