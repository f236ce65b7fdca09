// SPDX-License-Identifier: Apache-2.0
// Reads <dataTypes>, <interface> and <globalVars> of a PLCopen file as declarations.

#pragma once

#include <vector>

#include "control/plc/model/ast.h"
#include "control/plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// Reads one list of variables: <localVars>, <globalVars>...
void read_variables(const Node& list, ast::Section section, const std::string& what, std::vector<ast::Variable>& into,
                    Diagnostics& diagnostics);
// Reads all lists of an interface and, for functions, the type of the result.
void read_interface(const Node& interface, const std::string& what, ast::Pou& pou, Diagnostics& diagnostics);
// Adds quotes to initial values of STRING: Beremiz and the OpenPLC editor write them without, CODESYS (where it may be
// a constant) with.
void quote_texts(Node& root);
void read_data_type(const Node& node, std::vector<ast::TypeDeclaration>& into, Diagnostics& diagnostics);
void read_data_types(const Node& list, std::vector<ast::TypeDeclaration>& into, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
