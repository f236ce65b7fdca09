// SPDX-License-Identifier: Apache-2.0
// CONFIGURATION with its resources, tasks and programs, VAR_CONFIG and VAR_ACCESS of Structured Text.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plc/model/project.h"
#include "plc/st/declaration_parser.h"

namespace indurop::plc::st {

class ConfigurationParser {
 public:
  explicit ConfigurationParser(TokenReader& in) : in_(in), expressions_(in), declarations_(in) {}

  // CONFIGURATION, VAR_CONFIG or VAR_ACCESS, one of which comes next.
  void element(Project& to);
  // VAR_ACCESS, which comes next; of the PROGRAM of this name, unless it is empty.
  void accesses(const std::string& program, std::vector<Access>& to);

 private:
  void configuration(Project& to);
  void resource(std::vector<Resource>& to);
  [[nodiscard]] bool resource_item(Resource& out);
  [[nodiscard]] bool task(Resource& out);
  [[nodiscard]] bool task_property(Task& out);
  [[nodiscard]] bool program(Resource& out);
  [[nodiscard]] bool connection(ProgramInstance& out);
  void configured(std::vector<Configured>& to);
  [[nodiscard]] bool configured(Configured& out);
  [[nodiscard]] bool access(Access& out);
  // What is named from outside, resource.program.instance.variable: what leads to an address is left out.
  [[nodiscard]] std::optional<ast::Expression> path();
  [[nodiscard]] bool name(std::string& to, std::string_view what);
  template <class Item>
  [[nodiscard]] bool in_brackets(Item item, std::string_view behind);
  template <class Item>
  void up_to_end_var(std::string_view section, Item item);
  // Behind the next ';', or before a word that begins with END_.
  void recover();

  TokenReader& in_;
  ExpressionParser expressions_;
  DeclarationParser declarations_;
};

}  // namespace indurop::plc::st
