// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/declaration_writer.h"

#include <fmt/format.h>

#include "control/plc/plcopen/extensions.h"
#include "control/plc/print/expression_text.h"

namespace indurop::plc::plcopen {
namespace {

using ast::TypeSpec;

const char* list_name(ast::Section section) noexcept {
  switch (section) {
    case ast::Section::Local:
      return "localVars";
    case ast::Section::Input:
      return "inputVars";
    case ast::Section::Output:
      return "outputVars";
    case ast::Section::InOut:
      return "inOutVars";
    case ast::Section::Temp:
      return "tempVars";
    case ast::Section::External:
      return "externalVars";
    case ast::Section::Global:
      return "globalVars";
  }
  return "";
}

bool same_list(const ast::Variable& a, const ast::Variable& b) noexcept {
  return a.section == b.section && a.constant == b.constant && a.retain == b.retain && a.non_retain == b.non_retain;
}

}  // namespace

void DeclarationWriter::refuse(const Place& at, std::string_view what) {
  diagnostics_.error(at,
                     fmt::format("{} is not part of PLCopen XML 2.01; only programs without it are exported", what));
}

void DeclarationWriter::type(const ast::TypeDeclaration& declared) {
  if (!declared.scope.space.empty()) {
    refuse(declared.at, "NAMESPACE");
    return;
  }
  out_.open("dataType", {{"name", declared.name}});
  holder("baseType", declared.type);
  if (declared.initial) {
    initial(*declared.initial);
  }
  if (!declared.comment.empty()) {
    out_.formatted("documentation", declared.comment);
  }
  out_.close();
}

void DeclarationWriter::interface(const ast::Pou& pou) {
  out_.open("interface");
  if (pou.result) {
    holder("returnType", *pou.result);
  }
  lists(pou.variables);
  out_.close();
}

void DeclarationWriter::globals(const std::vector<ast::Variable>& variables) {
  lists(variables);
}

void DeclarationWriter::lists(const std::vector<ast::Variable>& variables) {
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const ast::Variable& one = variables[i];
    if (i == 0 || !same_list(one, variables[i - 1])) {
      XmlWriter::Attributes attributes;
      if (one.constant) {
        attributes.emplace_back("constant", "true");
      }
      if (one.retain) {
        attributes.emplace_back("retain", "true");
      }
      if (one.non_retain) {
        attributes.emplace_back("nonretain", "true");
      }
      out_.open(list_name(one.section), attributes);
    }
    variable(one);
    if (i + 1 == variables.size() || !same_list(one, variables[i + 1])) {
      out_.close();
    }
  }
}

void DeclarationWriter::variable(const ast::Variable& one) {
  if (one.name.empty()) {
    diagnostics_.error(one.at, "a variable without a name is not part of PLCopen XML 2.01; give it one");
  }
  if (one.is_static || one.of_instance) {
    refuse(one.at, one.is_static ? "VAR_STAT" : "VAR_INST");
  }
  XmlWriter::Attributes attributes{{"name", one.name}};
  if (one.address) {
    attributes.emplace_back("address", to_string(*one.address));
  }
  out_.open("variable", attributes);
  holder("type", one.type);
  if (one.initial) {
    initial(*one.initial);
  }
  edge(one);
  if (!one.comment.empty()) {
    out_.formatted("documentation", one.comment);
  }
  out_.close();
}

void DeclarationWriter::edge(const ast::Variable& one) {
  if (one.edge == ast::Edge::None) {
    return;
  }
  const bool rising = one.edge == ast::Edge::Rising;
  diagnostics_.warning(one.at, fmt::format("{} is written as an extension of PLCopen XML, which other editors do not "
                                           "know; for them use {} in the body",
                                           rising ? "R_EDGE" : "F_EDGE", rising ? "R_TRIG" : "F_TRIG"));
  out_.open("addData");
  out_.open("data", {{"name", std::string(kEdgeExtension)}, {"handleUnknown", "preserve"}});
  out_.attribute_text("edge", "xmlns", "", rising ? "rising" : "falling");
  out_.close();
  out_.close();
}

void DeclarationWriter::holder(std::string_view name, const TypeSpec& of) {
  out_.open(name);
  spec(of);
  out_.close();
}

void DeclarationWriter::spec(const TypeSpec& of) {
  switch (of.kind) {
    case TypeSpec::Kind::Elementary:
      if (is_character(of.elementary)) {
        refuse(of.at, name_of(of.elementary));
      }
      elementary(of.elementary);
      break;
    case TypeSpec::Kind::String:
      out_.leaf(of.elementary == Elementary::Wstring ? "wstring" : "string",
                of.length ? XmlWriter::Attributes{{"length", expression_text(*of.length)}} : XmlWriter::Attributes{});
      break;
    case TypeSpec::Kind::Named:
      out_.leaf("derived", {{"name", of.name}});
      break;
    case TypeSpec::Kind::Array:
      array(of);
      break;
    case TypeSpec::Kind::Subrange:
      subrange(of);
      break;
    case TypeSpec::Kind::Struct:
      if (of.element != nullptr) {
        refuse(of.at, "EXTENDS of a STRUCT");
      }
      structure(of);
      break;
    case TypeSpec::Kind::Enum:
      enumeration(of);
      break;
    case TypeSpec::Kind::Pointer:
      if (of.pointer != ast::PointerKind::PointerTo) {
        refuse(of.at, of.pointer == ast::PointerKind::RefTo ? "REF_TO" : "REFERENCE TO");
        break;
      }
      out_.open("pointer");
      holder("baseType", *of.element);
      out_.close();
      break;
    case TypeSpec::Kind::Inferred:
      break;  // only after an error
  }
}

void DeclarationWriter::typed(const TypeSpec& type, const ast::Initial* value) {
  holder("type", type);
  if (value != nullptr) {
    initial(*value);
  }
}

void DeclarationWriter::elementary(Elementary type) {
  const std::string_view name = type == Elementary::TimeOfDay     ? "TOD"
                                : type == Elementary::DateAndTime ? "DT"
                                                                  : name_of(type);
  out_.leaf(name);
}

void DeclarationWriter::array(const TypeSpec& of) {
  if (of.open) {
    refuse(of.at, "ARRAY[*]");
    return;
  }
  out_.open("array");
  for (const ast::Dimension& one : of.dimensions) {
    out_.leaf("dimension", {{"lower", expression_text(one.low)}, {"upper", expression_text(one.high)}});
  }
  holder("baseType", *of.element);
  out_.close();
}

void DeclarationWriter::subrange(const TypeSpec& of) {
  out_.open(is_unsigned_int(of.elementary) ? "subrangeUnsigned" : "subrangeSigned");
  out_.leaf("range", {{"lower", expression_text(of.range->low)}, {"upper", expression_text(of.range->high)}});
  out_.open("baseType");
  elementary(of.elementary);
  out_.close();
  out_.close();
}

void DeclarationWriter::enumeration(const TypeSpec& of) {
  out_.open("enum");
  out_.open("values");
  for (const ast::EnumValue& one : of.values) {
    XmlWriter::Attributes attributes{{"name", one.name}};
    if (one.value) {
      attributes.emplace_back("value", expression_text(*one.value));
    }
    out_.leaf("value", attributes);
  }
  out_.close();
  if (of.elementary != Elementary::Int) {
    out_.open("baseType");
    elementary(of.elementary);
    out_.close();
  }
  out_.close();
}

void DeclarationWriter::structure(const TypeSpec& of) {
  if (of.overlaps) {
    refuse(of.at, "UNION");
    return;
  }
  out_.open("struct");
  for (const ast::Variable& field : of.fields) {
    variable(field);
  }
  out_.close();
}

void DeclarationWriter::initial(const ast::Initial& of) {
  out_.open("initialValue");
  value(of);
  out_.close();
}

void DeclarationWriter::value(const ast::Initial& of) {
  if (of.kind == ast::Initial::Kind::Value) {
    out_.leaf("simpleValue", {{"value", of.value ? expression_text(*of.value) : std::string()}});
    return;
  }
  const bool list = of.kind == ast::Initial::Kind::Array;
  out_.open(list ? "arrayValue" : "structValue");
  for (const ast::InitialElement& one : of.elements) {
    XmlWriter::Attributes attributes;
    if (!list) {
      attributes.emplace_back("member", one.field);
    } else if (one.count) {
      attributes.emplace_back("repetitionValue", expression_text(*one.count));
    }
    out_.open("value", attributes);
    value(one.value);
    out_.close();
  }
  out_.close();
}

}  // namespace indurop::plc::plcopen
