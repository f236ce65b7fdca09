// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/type_text.h"

#include <fmt/format.h>

#include "plc/model/elementary.h"

namespace indurop::plc::plcopen {
namespace {

std::string subrange_text(const Node& type, Diagnostics& diagnostics) {
  const Node* range = type.child("range");
  const Node* base = type.child("baseType");
  if (range == nullptr || base == nullptr) {
    diagnostics.error(type.at, "a subrange has a <range> and a <baseType>");
    return {};
  }
  return fmt::format("{} ({}..{})", type_text(*base, diagnostics), range->attribute("lower"),
                     range->attribute("upper"));
}

std::string array_text(const Node& type, Diagnostics& diagnostics) {
  std::string dimensions;
  for (const Node& node : type.children) {
    if (node.name == "dimension") {
      dimensions +=
          fmt::format("{}{}..{}", dimensions.empty() ? "" : ", ", node.attribute("lower"), node.attribute("upper"));
    }
  }
  const Node* base = type.child("baseType");
  if (dimensions.empty() || base == nullptr) {
    diagnostics.error(type.at, "an array has at least one <dimension> and a <baseType>");
    return {};
  }
  return fmt::format("ARRAY[{}] OF {}", dimensions, type_text(*base, diagnostics));
}

std::string enum_text(const Node& type) {
  std::string values;
  const Node* list = type.child("values");
  for (const Node& node : children_of(list)) {
    if (node.name == "value") {
      values += (values.empty() ? "" : ", ") + std::string(node.attribute("name"));
      values += node.has("value") && !node.attribute("value").empty() ? fmt::format(" := {}", node.attribute("value"))
                                                                      : std::string();
    }
  }
  return "(" + values + ")";
}

std::string struct_text(const Node& type, Diagnostics& diagnostics) {
  std::string fields;
  for (const Node& node : type.children) {
    const Node* field_type = node.name == "variable" ? node.child("type") : nullptr;
    if (field_type == nullptr) {
      continue;
    }
    fields += fmt::format(" {} : {}", node.attribute("name"), type_text(*field_type, diagnostics));
    const Node* initial = node.child("initialValue");
    const std::string value = initial == nullptr ? std::string() : value_text(*initial);
    fields += value.empty() ? ";" : " := " + value + ";";
  }
  return "STRUCT" + fields + " END_STRUCT";
}

std::string one_type_text(const Node& type, Diagnostics& diagnostics) {
  if (type.name == "derived") {
    return std::string(type.attribute("name"));
  }
  if (type.name == "string") {
    return type.has("length") ? fmt::format("STRING[{}]", type.attribute("length")) : "STRING";
  }
  if (type.name == "array") {
    return array_text(type, diagnostics);
  }
  if (type.name == "subrangeSigned" || type.name == "subrangeUnsigned") {
    return subrange_text(type, diagnostics);
  }
  if (type.name == "enum") {
    return enum_text(type);
  }
  if (type.name == "struct") {
    return struct_text(type, diagnostics);
  }
  if (elementary_named(type.name)) {
    return type.name;
  }
  if (type.name == "pointer") {
    diagnostics.error(type.at, "there are no pointers here, use VAR_IN_OUT or an array");
    return {};
  }
  const bool wide = type.name == "wstring";
  diagnostics.error(type.at,
                    wide ? std::string("WSTRING is not supported; use STRING, which holds UTF-8")
                         : fmt::format("<{}> is not a data type this compiler knows; use an elementary type, an "
                                       "array, a structure, an enumeration or a type of the project",
                                       type.name));
  return {};
}

}  // namespace

std::string type_text(const Node& type, Diagnostics& diagnostics) {
  for (const Node& node : type.children) {
    if (node.name != "addData" && node.name != "documentation") {
      return one_type_text(node, diagnostics);
    }
  }
  diagnostics.error(type.at, "here a data type is missing; write <BOOL/>, <INT/> ... or <derived name=\"...\"/>");
  return {};
}

std::string value_text(const Node& value) {
  if (const Node* simple = value.child("simpleValue")) {
    return std::string(simple->attribute("value"));
  }
  const Node* array = value.child("arrayValue");
  const Node* structure = value.child("structValue");
  const Node* list = array != nullptr ? array : structure;
  if (list == nullptr) {
    return {};
  }
  std::string items;
  for (const Node& node : list->children) {
    if (node.name != "value") {
      continue;
    }
    const std::string item = value_text(node);
    items += items.empty() ? "" : ", ";
    if (structure == list) {
      items += fmt::format("{} := {}", node.attribute("member"), item);
    } else if (node.has("repetitionValue") && node.attribute("repetitionValue") != "1") {
      items += fmt::format("{}({})", node.attribute("repetitionValue"), item);
    } else {
      items += item;
    }
  }
  return array == list ? "[" + items + "]" : "(" + items + ")";
}

}  // namespace indurop::plc::plcopen
