// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/declarations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <utility>

#include "control/plc/model/elementary.h"
#include "control/plc/model/make.h"
#include "control/plc/plcopen/body_reader.h"
#include "control/plc/plcopen/extensions.h"
#include "control/plc/plcopen/type_reader.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::plcopen {
namespace {

constexpr std::array<std::pair<std::string_view, ast::Section>, 6> kLists{{{"localVars", ast::Section::Local},
                                                                           {"inputVars", ast::Section::Input},
                                                                           {"outputVars", ast::Section::Output},
                                                                           {"inOutVars", ast::Section::InOut},
                                                                           {"tempVars", ast::Section::Temp},
                                                                           {"externalVars", ast::Section::External}}};

void read_address(const Node& node, ast::Variable& variable, Diagnostics& diagnostics) {
  const std::string_view text = node.attribute("address");
  Place at = node.value_at("address");
  at.within = variable.at.within;
  const auto address = st::parse_expression({text, at}, diagnostics);
  if (!address) {
    return;
  }
  if (address->kind == ast::Expression::Kind::Direct) {
    variable.address = address->address;
  } else {
    diagnostics.error(at, fmt::format("address=\"{}\" is not an address such as %IX0.0 or %QW2", text));
  }
}

ast::Edge edge_of(const Node& variable) {
  for (const Node& data : children_of(variable.child("addData"))) {
    if (data.attribute("name") == kEdgeExtension) {
      return formatted_text(data) == "rising" ? ast::Edge::Rising : ast::Edge::Falling;
    }
  }
  return ast::Edge::None;
}

// Reads fb : Motor(speed := 3), which CODESYS and TwinCAT store next to the type.
void read_starts(const Node& variable, const std::string& what, ast::TypeSpec& type, Diagnostics& diagnostics) {
  ast::StartArguments given;
  for (const Node& data : children_of(variable.child("addData"))) {
    const Node* list = data.attribute("name") == kStartExtension ? data.child("InputAssignments") : nullptr;
    for (const Node& one : children_of(list)) {
      const Node* name = one.child("Name");
      const Node* value = one.child("Value");
      if (value == nullptr) {
        continue;
      }
      ast::Argument& made = given.emplace_back();
      made.at = within(value->at, what);
      made.name = name != nullptr ? name->text : "";
      made.value = st::parse_expression({value->text, within(value->text_at, what)}, diagnostics);
    }
  }
  if (!given.empty()) {
    ast::TypeSpec& of = type.kind == ast::TypeSpec::Kind::Array ? *type.element : type;
    of.starts.push_back(std::move(given));
  }
}

void read_variable(const Node& node, ast::Variable variable, const std::string& what, std::vector<ast::Variable>& into,
                   Diagnostics& diagnostics) {
  variable.name = std::string(node.attribute("name"));
  const std::string whole = fmt::format("{}, variable {}", what, variable.name);
  variable.at = within(node.at, whole);
  variable.comment = comment_of(node);
  const Node* type = node.child("type");
  if (variable.name.empty() || type == nullptr) {
    diagnostics.error(variable.at, "a <variable> has a name and a <type>");
    return;
  }
  auto read = read_type(*type, whole, diagnostics);
  if (!read) {
    return;
  }
  variable.type = std::move(*read);
  read_starts(node, whole, variable.type, diagnostics);
  if (!node.attribute("address").empty()) {
    read_address(node, variable, diagnostics);
  }
  variable.initial = read_initial(node, whole, diagnostics);
  variable.edge = edge_of(node);
  into.push_back(std::move(variable));
}

std::string quote(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    out += c == '\'' ? "$'" : std::string(1, c);
  }
  return out + "'";
}

}  // namespace

void read_variables(const Node& list, ast::Section section, const std::string& what, std::vector<ast::Variable>& into,
                    Diagnostics& diagnostics) {
  ast::Variable form;
  form.section = section;
  form.constant = list.is_true("constant");
  form.retain = list.is_true("retain") || list.is_true("persistent");
  form.non_retain = list.is_true("nonretain");
  for (const Node& node : list.children) {
    if (node.name == "variable") {
      read_variable(node, form, what, into, diagnostics);
    }
  }
}

void read_interface(const Node& interface, const std::string& what, ast::Pou& pou, Diagnostics& diagnostics) {
  for (const Node& node : interface.children) {
    const auto* list =
        std::find_if(kLists.begin(), kLists.end(), [&](const auto& known) { return known.first == node.name; });
    if (node.name == "globalVars") {  // VAR_STAT, as CODESYS and TwinCAT write it
      const std::size_t before = pou.variables.size();
      read_variables(node, ast::Section::Local, what, pou.variables, diagnostics);
      std::for_each(pou.variables.begin() + static_cast<std::ptrdiff_t>(before), pou.variables.end(),
                    [](ast::Variable& one) { one.is_static = true; });
    } else if (list != kLists.end()) {
      read_variables(node, list->second, what, pou.variables, diagnostics);
    } else if (node.name == "returnType") {
      pou.result = read_type(node, what, diagnostics);
    } else if (node.name == "accessVars" && pou.kind != ast::Pou::Kind::Program) {
      diagnostics.error(within(node.at, what), "VAR_ACCESS is for programs and configurations, remove it");
    } else if (node.name != "accessVars" && node.name != "addData" && node.name != "documentation" &&
               node.name != "Attributes") {  // settings of a property for the editor of CODESYS
      diagnostics.error(within(node.at, what), fmt::format("<{}> is not a part of an interface; remove it", node.name));
    }
  }
}

namespace {

void quote_texts(Node& node, const std::set<std::string>& text_types) {
  const Node* type = node.child("type") != nullptr ? node.child("type") : node.child("baseType");
  const Node* derived = type == nullptr ? nullptr : type->child("derived");
  const bool text = type != nullptr && (type->child("string") != nullptr ||
                                        (derived != nullptr && text_types.contains(upper(derived->attribute("name")))));
  for (Node& child : node.children) {
    quote_texts(child, text_types);
    if (!text || child.name != "initialValue") {
      continue;
    }
    for (Node& value : child.children) {
      for (Attribute& attribute : value.attributes) {
        if (attribute.name == "value" && !attribute.value.empty() && attribute.value.front() != '\'') {
          attribute.value = quote(attribute.value);
        }
      }
    }
  }
}

}  // namespace

void quote_texts(Node& root) {
  std::set<std::string> text_types{"HMI_STRING"};  // of Beremiz' SVGHMI, which is a file of its own
  const Node* types = root.child("types");
  const Node* list = types == nullptr ? nullptr : types->child("dataTypes");
  for (const Node& declared : children_of(list)) {
    const Node* base = declared.child("baseType");
    if (base != nullptr && base->child("string") != nullptr) {
      text_types.insert(upper(declared.attribute("name")));
    }
  }
  quote_texts(root, text_types);
}

void read_data_type(const Node& node, std::vector<ast::TypeDeclaration>& into, Diagnostics& diagnostics) {
  ast::TypeDeclaration declared;
  declared.name = std::string(node.attribute("name"));
  const std::string what = "type " + declared.name;
  declared.at = within(node.at, what);
  declared.comment = comment_of(node);
  const Node* base = node.child("baseType");
  if (declared.name.empty() || base == nullptr) {
    diagnostics.error(declared.at, "a <dataType> has a name and a <baseType>");
    return;
  }
  auto read = read_type(*base, what, diagnostics);
  if (!read) {
    return;
  }
  declared.type = std::move(*read);
  for (const Node& data : children_of(node.child("addData"))) {
    const Node* inheritance = data.child("Inheritance");
    const Node* extends = inheritance == nullptr ? nullptr : inheritance->child("Extends");
    if (extends != nullptr && declared.type.kind == ast::TypeSpec::Kind::Struct) {
      declared.type.element = std::make_shared<ast::TypeSpec>(make::type(declared.at, extends->text));
    }
  }
  declared.initial = read_initial(node, what, diagnostics);
  into.push_back(std::move(declared));
}

void read_data_types(const Node& list, std::vector<ast::TypeDeclaration>& into, Diagnostics& diagnostics) {
  for (const Node& node : list.children) {
    if (node.name == "dataType") {
      read_data_type(node, into, diagnostics);
    }
  }
}

}  // namespace indurop::plc::plcopen
