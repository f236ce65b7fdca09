// SPDX-License-Identifier: Apache-2.0
// <dataTypes>, <interface> and <globalVars> of a PLCopen file as declarations.

#pragma once

#include <vector>

#include "plc/model/ast.h"
#include "plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// One list of variables: <localVars>, <globalVars>...
void read_variables(const Node& list, ast::Section section, const std::string& what, std::vector<ast::Variable>& into,
                    Diagnostics& diagnostics);
// All lists of an interface and, of functions, the type of the result.
void read_interface(const Node& interface, const std::string& what, ast::Pou& pou, Diagnostics& diagnostics);
// Beremiz and the OpenPLC editor write initial values of STRING without quotes, CODESYS (a constant may stand there)
// with.
void quote_texts(Node& root);
void read_data_type(const Node& node, std::vector<ast::TypeDeclaration>& into, Diagnostics& diagnostics);
void read_data_types(const Node& list, std::vector<ast::TypeDeclaration>& into, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
