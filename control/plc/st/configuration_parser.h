// SPDX-License-Identifier: Apache-2.0
// Parses CONFIGURATION with its resources, tasks and programs, VAR_CONFIG and VAR_ACCESS of Structured Text.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/plc/model/project.h"
#include "control/plc/st/declaration_parser.h"

namespace indurop::plc::st {

class ConfigurationParser {
 public:
  explicit ConfigurationParser(TokenReader& in) : in_(in), expressions_(in), declarations_(in) {}

  // Parses CONFIGURATION, VAR_CONFIG or VAR_ACCESS; requires that one of them is next.
  void element(Project& to);
  // Parses VAR_ACCESS, which must be next; of the PROGRAM of this name, unless it is empty.
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
  // Parses the path of an item named from outside, resource.program.instance.variable; the part before an address is
  // left out.
  [[nodiscard]] std::optional<ast::Expression> path();
  [[nodiscard]] bool name(std::string& to, std::string_view what);
  template <class Item>
  [[nodiscard]] bool in_brackets(Item item, std::string_view behind);
  template <class Item>
  void up_to_end_var(std::string_view section, Item item);
  // Skips to the position after the next ';', or before a word that begins with END_.
  void recover();

  TokenReader& in_;
  ExpressionParser expressions_;
  DeclarationParser declarations_;
};

}  // namespace indurop::plc::st
