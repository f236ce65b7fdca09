// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/type_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "control/plc/model/elementary.h"
#include "control/plc/plcopen/body_reader.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::plcopen {
namespace {

using ast::TypeSpec;

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

class TypeReader {
 public:
  TypeReader(const std::string& what, Diagnostics& diagnostics)
      : what_(std::make_shared<const std::string>(what)), diagnostics_(diagnostics) {}

  std::optional<TypeSpec> type(const Node& holder) {
    for (const Node& node : holder.children) {
      if (node.name != "addData" && node.name != "documentation") {
        TypeSpec out;
        out.at = place(node.at);
        return one_type(node, out) ? std::optional(std::move(out)) : std::nullopt;
      }
    }
    error(holder, "here a data type is missing; write <BOOL/>, <INT/> ... or <derived name=\"...\"/>");
    return std::nullopt;
  }

  // Reads the content of a <value> or <initialValue>.
  std::optional<ast::Initial> initial(const Node& node) {
    if (const Node* simple = node.child("simpleValue")) {
      return st::parse_initial({simple->attribute("value"), place(simple->value_at("value"))}, diagnostics_);
    }
    const Node* array = node.child("arrayValue");
    const Node* list = array != nullptr ? array : node.child("structValue");
    if (list == nullptr) {
      error(node, "here a value is missing; write <simpleValue value=\"...\"/>, <arrayValue> or <structValue>");
      return std::nullopt;
    }
    ast::Initial out;
    out.at = place(list->at);
    out.kind = list == array ? ast::Initial::Kind::Array : ast::Initial::Kind::Struct;
    for (const Node& value : list->children) {
      if (value.name == "value" && !element(value, out)) {
        return std::nullopt;
      }
    }
    return out;
  }

 private:
  [[nodiscard]] Place place(Place at) const {
    at.within = what_;
    return at;
  }
  void error(const Node& at, std::string text) { diagnostics_.error(place(at.at), std::move(text)); }

  std::optional<ast::Expression> expression(const Node& node, std::string_view attribute) {
    return st::parse_expression({node.attribute(attribute), place(node.value_at(attribute))}, diagnostics_);
  }

  bool one_type(const Node& node, TypeSpec& out) {
    if (node.name == "derived") {
      return derived(node, out);
    }
    if (node.name == "string" || node.name == "wstring") {
      return text(node, node.name == "string" ? Elementary::String : Elementary::Wstring, out);
    }
    if (node.name == "array") {
      return array(node, out);
    }
    if (node.name == "subrangeSigned" || node.name == "subrangeUnsigned") {
      return subrange(node, out);
    }
    if (node.name == "enum") {
      return enumeration(node, out);
    }
    if (node.name == "struct") {
      return structure(node, out);
    }
    if (node.name == "pointer") {
      return pointer(node, out);
    }
    if (const auto known = elementary_named(node.name)) {
      elementary(*known, out);
      return true;
    }
    refuse(node);
    return false;
  }

  bool pointer(const Node& node, TypeSpec& out) {
    out.kind = TypeSpec::Kind::Pointer;
    const Node* base = node.child("baseType");
    auto element = type(base != nullptr ? *base : node);
    if (element) {
      out.element = std::make_shared<TypeSpec>(std::move(*element));
    }
    return element.has_value();
  }

  void refuse(const Node& node) {
    error(node, fmt::format("<{}> is not a data type this compiler knows; use an elementary type, an array, a "
                            "structure, an enumeration or a type of the project",
                            node.name));
  }

  static void elementary(Elementary known, TypeSpec& out) {
    out.kind = is_text(known) ? TypeSpec::Kind::String : TypeSpec::Kind::Elementary;
    out.elementary = known;
  }

  bool derived(const Node& node, TypeSpec& out) {
    out.name = std::string(node.attribute("name"));
    if (out.name.empty()) {
      error(node, "<derived> lacks the name of its type");
      return false;
    }
    if (out.name.find(' ') != std::string::npos) {  // REFERENCE TO Motor, as TwinCAT writes it
      auto read = st::parse_type({out.name, place(node.value_at("name"))}, diagnostics_);
      out = read ? std::move(*read) : TypeSpec();
      return read.has_value();
    }
    if (const auto known = elementary_named(out.name)) {
      elementary(*known, out);
      out.name.clear();
    } else {
      out.kind = TypeSpec::Kind::Named;
    }
    return true;
  }

  bool text(const Node& node, Elementary of, TypeSpec& out) {
    elementary(of, out);
    if (node.has("length")) {
      out.length = expression(node, "length");
    }
    return !node.has("length") || out.length;
  }

  bool range(const Node& node, ast::Dimension& out) {
    auto low = expression(node, "lower");
    auto high = expression(node, "upper");
    if (!low || !high) {
      return false;
    }
    out.low = std::move(*low);
    out.high = std::move(*high);
    return true;
  }

  bool array(const Node& node, TypeSpec& out) {
    out.kind = TypeSpec::Kind::Array;
    for (const Node& child : node.children) {
      if (child.name == "dimension" && !range(child, out.dimensions.emplace_back())) {
        return false;
      }
    }
    const Node* base = node.child("baseType");
    if (out.dimensions.empty() || base == nullptr) {
      error(node, "an array has at least one <dimension> and a <baseType>");
      return false;
    }
    auto element = type(*base);
    out.element = element ? std::make_shared<TypeSpec>(std::move(*element)) : nullptr;
    return element.has_value();
  }

  bool subrange(const Node& node, TypeSpec& out) {
    const Node* limits = node.child("range");
    const Node* base = node.child("baseType");
    if (limits == nullptr || base == nullptr) {
      error(node, "a subrange has a <range> and a <baseType>");
      return false;
    }
    const auto of = type(*base);
    if (!of) {
      return false;
    }
    if (of->kind != TypeSpec::Kind::Elementary) {
      error(*base, "a subrange is one of an elementary type of whole numbers, as <INT/>");
      return false;
    }
    out.kind = TypeSpec::Kind::Subrange;
    out.elementary = of->elementary;
    return range(*limits, out.range.emplace());
  }

  bool enumeration(const Node& node, TypeSpec& out) {
    out.kind = TypeSpec::Kind::Enum;
    for (const Node& child : children_of(node.child("values"))) {
      if (child.name != "value") {
        continue;
      }
      ast::EnumValue& made = out.values.emplace_back();
      made.at = place(child.at);
      made.name = std::string(child.attribute("name"));
      if (!child.attribute("value").empty()) {
        made.value = expression(child, "value");
        if (!made.value) {
          return false;
        }
      }
    }
    if (out.values.empty()) {
      error(node, "an enumeration has <values> with at least one <value name=\"...\"/>");
      return false;
    }
    const Node* base = node.child("baseType");
    const auto of = base == nullptr ? std::nullopt : type(*base);
    if (of && of->kind == TypeSpec::Kind::Elementary) {
      out.elementary = of->elementary;
    }
    return base == nullptr || of;
  }

  bool structure(const Node& node, TypeSpec& out) {
    out.kind = TypeSpec::Kind::Struct;
    bool fine = true;
    for (const Node& child : node.children) {
      const Node* of = child.name == "variable" ? child.child("type") : nullptr;
      if (of == nullptr) {
        continue;
      }
      ast::Variable field;
      field.at = place(child.at);
      field.name = std::string(child.attribute("name"));
      field.comment = comment_of(child);
      auto spec = type(*of);
      fine = fine && spec;
      if (spec) {
        field.type = std::move(*spec);
        field.initial = read_initial(child, *what_, diagnostics_);
        out.fields.push_back(std::move(field));
      }
    }
    return fine;
  }

  bool element(const Node& node, ast::Initial& of) {
    ast::InitialElement made;
    if (of.kind == ast::Initial::Kind::Struct) {
      made.field = std::string(node.attribute("member"));
    } else if (node.has("repetitionValue") && node.attribute("repetitionValue") != "1") {
      made.count = expression(node, "repetitionValue");
      if (!made.count) {
        return false;
      }
    }
    auto value = initial(node);
    if (!value) {
      return false;
    }
    made.value = std::move(*value);
    of.elements.push_back(std::move(made));
    return true;
  }

  std::shared_ptr<const std::string> what_;
  Diagnostics& diagnostics_;
};

bool is_empty(const Node& initial) {
  const Node* simple = initial.child("simpleValue");
  return simple != nullptr ? simple->attribute("value").empty()
                           : initial.child("arrayValue") == nullptr && initial.child("structValue") == nullptr;
}

}  // namespace

std::optional<TypeSpec> read_type(const Node& holder, const std::string& what, Diagnostics& diagnostics) {
  return TypeReader(what, diagnostics).type(holder);
}

std::optional<ast::Initial> read_initial(const Node& holder, const std::string& what, Diagnostics& diagnostics) {
  const Node* given = holder.child("initialValue");
  return given == nullptr || is_empty(*given) ? std::nullopt : TypeReader(what, diagnostics).initial(*given);
}

std::string comment_of(const Node& node) {
  const Node* documentation = node.child("documentation");
  return documentation == nullptr ? std::string() : one_line(formatted_text(*documentation));
}

}  // namespace indurop::plc::plcopen
