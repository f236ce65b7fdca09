// SPDX-License-Identifier: Apache-2.0
// The data that the parts of the checker share while they process a project.

#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/plc/check/program.h"
#include "control/plc/model/diagnostics.h"

namespace indurop::plc {

// An initial value of a variable of `pou`; null: of a global.
struct OpenInitial {
  ast::Initial* initial = nullptr;
  const Type* type = nullptr;
  Pou* pou = nullptr;
};

struct Context {
  Program& program;
  Diagnostics& diagnostics;
  Pou* pou = nullptr;  // the POU being checked
  // The variables of the surrounding FOR statements (each a Variable or a Global) and the places of the loops.
  std::vector<std::pair<const void*, Place>> loop_variables{};
  // Names whose declaration has an error, or that a POU uses without a declaration: reported once. POU null: a global.
  std::set<std::pair<const Pou*, std::string>> known_errors{};
  // Initial values of instances, wherever their function blocks are declared: checked when all variables are known.
  std::vector<OpenInitial> open_initials{};
  // Names of declared types in capitals, including those whose declaration has errors.
  std::set<std::string> declared_types{};
  // The last number used to make a name for a type without one, by the first part of the name.
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
  // Errors in generated texts name the POU too.
  [[nodiscard]] std::string located(std::string text) const {
    return pou != nullptr ? pou->title() + ": " + text : std::move(text);
  }
};

// Reports that the name is not declared: once per POU, and never for a global whose declaration has an error.
void complain_undeclared(Context& context, const Place& at, const std::string& name);

// Returns ", did you mean 'x'?" with the name in `known` closest to it, or "". It does not search when further errors
// are not kept: thousands of searches in thousands of names would take longer than the rest of the check.
[[nodiscard]] std::string did_you_mean(const Context& context, std::string_view name,
                                       const std::vector<std::string>& known);

}  // namespace indurop::plc
