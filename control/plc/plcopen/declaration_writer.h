// SPDX-License-Identifier: Apache-2.0
// Writes types, variables and initial values as elements of a PLCopen file. What the format does not support is an
// error.

#pragma once

#include <string>
#include <vector>

#include "control/plc/model/ast.h"
#include "control/plc/model/diagnostics.h"
#include "control/plc/plcopen/xml_writer.h"

namespace indurop::plc::plcopen {

class DeclarationWriter {
 public:
  DeclarationWriter(XmlWriter& out, Diagnostics& diagnostics) : out_(out), diagnostics_(diagnostics) {}

  // <dataType>
  void type(const ast::TypeDeclaration& declared);
  // Writes <interface>, with the type of the result.
  void interface(const ast::Pou& pou);
  // Writes one <globalVars> for each run of consecutive variables with the same attributes.
  void globals(const std::vector<ast::Variable>& variables);
  // Writes <type> and, unless it is null, <initialValue>.
  void typed(const ast::TypeSpec& type, const ast::Initial* value);

 private:
  void lists(const std::vector<ast::Variable>& variables);
  void variable(const ast::Variable& one);
  void edge(const ast::Variable& one);
  void holder(std::string_view name, const ast::TypeSpec& of);
  void spec(const ast::TypeSpec& of);
  void array(const ast::TypeSpec& of);
  void subrange(const ast::TypeSpec& of);
  void enumeration(const ast::TypeSpec& of);
  void structure(const ast::TypeSpec& of);
  void initial(const ast::Initial& of);
  void value(const ast::Initial& of);
  void elementary(Elementary type);
  // Reports "<what> is not part of PLCopen XML".
  void refuse(const Place& at, std::string_view what);

  XmlWriter& out_;
  Diagnostics& diagnostics_;
};

}  // namespace indurop::plc::plcopen
