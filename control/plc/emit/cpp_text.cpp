// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/cpp_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "control/plc/library/standard.h"
#include "control/plc/model/characters.h"
#include "glb2idl/names.h"
#include "glb2idl/text.h"

namespace indurop::plc {
namespace {

// Words of C++, macros of the C library; then, from std on, names used by the generated code.
constexpr std::array<std::string_view, 117> kTaken{
    "alignas",     "alignof",   "and",        "and_eq",      "asm",      "auto",         "bitand",
    "bitor",       "bool",      "break",      "case",        "catch",    "char",         "char8_t",
    "char16_t",    "char32_t",  "class",      "compl",       "concept",  "const",        "consteval",
    "constexpr",   "constinit", "const_cast", "continue",    "co_await", "co_return",    "co_yield",
    "decltype",    "default",   "delete",     "do",          "double",   "dynamic_cast", "else",
    "enum",        "explicit",  "export",     "extern",      "false",    "float",        "for",
    "friend",      "goto",      "if",         "inline",      "int",      "long",         "mutable",
    "namespace",   "new",       "noexcept",   "not",         "not_eq",   "nullptr",      "operator",
    "or",          "or_eq",     "private",    "protected",   "public",   "register",     "reinterpret_cast",
    "requires",    "return",    "short",      "signed",      "sizeof",   "static",       "static_assert",
    "static_cast", "struct",    "switch",     "template",    "this",     "thread_local", "throw",
    "true",        "try",       "typedef",    "typeid",      "typename", "union",        "unsigned",
    "using",       "virtual",   "void",       "volatile",    "wchar_t",  "while",        "xor",
    "xor_eq",      "assert",    "errno",      "NULL",        "EOF",      "INFINITY",     "NAN",
    "unix",        "linux",     "stdin",      "stdout",      "stderr",   "std",          "iec",
    "irp",         "indurop",   "plc",        "scan",        "shared",   "before",       "kept",
    "BUFSIZ",      "main",      "run",        "POU_PROGRAM", "Image"};

// Returns true for names of variables that the emitters add to those of the program.
bool is_generated(std::string_view name) noexcept {
  const std::string_view letters = name.substr(0, name.find_last_not_of("0123456789") + 1);
  const bool numbered = letters.size() < name.size();
  const auto is = [&](std::string_view one) { return numbered && letters == one; };
  return is("one_") || is("case_") || is("loop_") || is("counter_") || is("end_") || is("begin_") || is("enabled_") ||
         is("operand_") || name == "result" || name == "guard_call" || name == "lifetime" || name == "calls_inside" ||
         name == "show" || name == "debugger" || name.starts_with("debug_") || name.starts_with("method_") ||
         name.starts_with("getter_") || name.starts_with("setter_") || name.starts_with("kept_") ||
         name.starts_with("out_") || name.ends_with("_result") || name.ends_with("_edge") || name.ends_with("_before");
}

std::string number(Integer value, const Type& type) {
  if (value == Integer{std::numeric_limits<std::int32_t>::min()}) {
    return "std::numeric_limits<std::int32_t>::min()";  // -2147483648 is a long in C++
  }
  if (value == Integer{std::numeric_limits<std::int64_t>::min()}) {
    return "std::numeric_limits<std::int64_t>::min()";
  }
  const bool large = value > Integer{std::numeric_limits<std::int32_t>::max()};
  std::string text = to_string(Constant(value));
  if (bits_of(type.elementary) == 64 || large) {
    text += is_unsigned_int(type.elementary) || is_bit(type.elementary) ? "U" : "";
  }
  return text;
}

std::string real(double value, const Type& type) {
  std::string text =
      type.is(Elementary::Real) ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) {
    text += ".0";
  }
  return text + (type.is(Elementary::Real) ? "F" : "");
}

std::string enumerator(Integer value, const Type& type) {
  for (const EnumItem& one : type.items) {
    if (Integer{one.value} == value) {
      return cpp_type(type) + "::" + (type.shared_name.empty() ? cpp_name(one.name) : one.name);
    }
  }
  return fmt::format("static_cast<{}>({})", cpp_type(type), to_string(Constant(value)));
}

std::string of_tree(const Type& type, const ValueTree& tree, std::size_t level) {
  if (tree.zero && type.kind != Type::Kind::Enum) {
    return "{}";
  }
  if (type.kind == Type::Kind::Elementary || type.kind == Type::Kind::Enum) {
    return cpp_constant(tree.value, type, true);
  }
  if (type.kind == Type::Kind::Struct) {
    std::string parts;
    for (std::size_t i = 0; i < tree.parts.size(); ++i) {
      parts += (i > 0 ? ", " : "") + of_tree(*type.fields[i].type, tree.parts[i], 0);
    }
    return cpp_type(type) + "{" + parts + "}";
  }
  const bool innermost = level + 1 == type.dimensions.size();
  const auto part = [&](const ValueTree& one) {
    return innermost ? of_tree(*type.element, one, 0) : of_tree(type, one, level + 1);
  };
  Type rest = type;  // of this dimension and the inner ones
  rest.dimensions.erase(rest.dimensions.begin(), rest.dimensions.begin() + static_cast<std::ptrdiff_t>(level));
  if (tree.equal_parts) {
    return fmt::format("iec::filled<{}>({})", cpp_type(rest), part(tree.parts[0]));
  }
  std::string parts;
  for (const ValueTree& one : tree.parts) {
    parts += (parts.empty() ? "" : ", ") + part(one);
  }
  return cpp_type(rest) + "{{" + parts + "}}";  // else a first {} would be taken for the whole
}

const Type& innermost(const Type& type) {
  return type.kind == Type::Kind::Array ? innermost(*type.element) : type;
}

// Returns assignments of the initial values of an instance, or of those of an array.
std::string of_instances(const std::string& target, const Type& type, const ast::Initial& initial);

// Row after row, only those that have values.
std::string of_blocks(const std::string& target, const Type& type, const ast::Initial& initial) {
  std::string text;
  std::uint64_t at = 0;
  for (const ast::Initial* one : initial_elements(initial, elements_of(type))) {
    std::string place;
    std::uint64_t rest = at++;
    for (auto dimension = type.dimensions.rbegin(); dimension != type.dimensions.rend(); ++dimension) {
      place.insert(0, fmt::format("[{}]", rest % dimension->count()));
      rest /= dimension->count();
    }
    if (one != nullptr) {
      text += of_instances(target + place, *type.element, *one);
    }
  }
  return text;
}

// Returns the assignments of inputs.
std::string of_block(const std::string& target, const Type& type, const ast::Initial& initial) {
  std::string text;
  for (const ast::InitialElement& one : initial.elements) {
    const Type* field = nullptr;
    std::string name = one.field;
    Type elementary;
    if (type.block != nullptr) {
      elementary.elementary = std::get<Elementary>(type.block->input(one.field)->type);
      field = &elementary;
    } else {
      field = type.pou->find(upper(one.field))->type;
      name = cpp_name(name);
    }
    text += innermost(*field).kind == Type::Kind::Block
                ? of_instances(target + "." + name, *field, one.value)
                : fmt::format("{}.{} = {}; ", target, name, cpp_initial(*field, &one.value));
  }
  return text;
}

std::string of_instances(const std::string& target, const Type& type, const ast::Initial& initial) {
  return type.kind == Type::Kind::Array ? of_blocks(target, type, initial) : of_block(target, type, initial);
}

}  // namespace

// Appends '_' if the name is taken, and one more if the result would be the name of another one: new, new_, new__.
std::string cpp_name(std::string_view name) {
  const std::string_view bare = name.substr(0, name.find_last_not_of('_') + 1);
  const bool taken = std::find(kTaken.begin(), kTaken.end(), bare) != kTaken.end() || is_generated(bare) ||
                     glb2idl::is_system_macro(bare) || bare.starts_with("__") || bare.starts_with("INDUROP_");
  return std::string(name) + (taken ? "_" : "");
}

std::string cpp_name(const Global& global) {
  std::string name = global.name;
  for (std::size_t at = name.find("::"); at != std::string::npos; at = name.find("::")) {
    name.replace(at, 2, "_");
  }
  return cpp_name(std::string_view(name));
}

std::string proxy_of(const Global& global) {
  return "::" + global.shared_name;
}

std::string cpp_type(const Type& type) {
  switch (type.kind) {
    case Type::Kind::Elementary:
      return type.is_text()
                 ? fmt::format("iec::{}<{}>", type.is(Elementary::String) ? "String" : "WString", type.length)
                 : std::string(cpp_type(type.elementary));
    case Type::Kind::Enum:
    case Type::Kind::Struct:
      return type.shared_name.empty() ? "plc::" + cpp_name(std::string_view(type.name)) : "::" + type.shared_name;
    case Type::Kind::Block:
      return type.block != nullptr ? type.block->cpp : "plc::" + cpp_name(std::string_view(type.pou->name));
    case Type::Kind::Interface:
      return fmt::format("iec::Interface<plc::{}>", cpp_name(std::string_view(type.pou->name)));
    case Type::Kind::Pointer:
      return fmt::format("iec::Pointer<{}>", cpp_type(*type.element));
    case Type::Kind::Array: {
      std::string text = cpp_type(*type.element);
      if (type.open) {
        return fmt::format("iec::Slice<{}, {}>", text, type.dimensions.size());
      }
      for (auto one = type.dimensions.rbegin(); one != type.dimensions.rend(); ++one) {
        text = fmt::format("std::array<{}, {}>", text, one->count());
      }
      return text;
    }
  }
  return "";
}

std::string cpp_constant(const Constant& value, const Type& type, bool exact) {
  if (const auto* flag = std::get_if<bool>(&value)) {
    return *flag ? "true" : "false";
  }
  if (const auto* one = std::get_if<double>(&value)) {
    return real(*one, type);
  }
  if (const auto* text = std::get_if<std::string>(&value)) {
    return fmt::format("{}({})", cpp_type(type), type.is(Elementary::Wstring) ? wide_quoted(*text) : quote(*text));
  }
  const Integer whole = std::get<Integer>(value);
  if (type.kind == Type::Kind::Enum) {
    return enumerator(whole, type);
  }
  const std::string text = number(whole, type);
  const bool plain = is_int(type.elementary) || is_bit(type.elementary);
  if (is_real(type.elementary)) {
    return real(static_cast<double>(whole), type);
  }
  return plain && (!exact || type.is(Elementary::Dint)) ? text : cpp_type(type) + "{" + text + "}";
}

std::string cpp_initial(const Type& type, const ast::Initial* initial) {
  const ast::Initial* const given = initial != nullptr ? initial : type.initial;
  if (innermost(type).kind == Type::Kind::Block && given != nullptr) {
    const char* const name = type.kind == Type::Kind::Block ? "block" : "blocks";
    return fmt::format("[] {{ {} {}{{}}; {}return {}; }}()", cpp_type(type), name, of_instances(name, type, *given),
                       name);
  }
  if (type.kind == Type::Kind::Pointer || innermost(type).kind == Type::Kind::Block) {
    return "{}";
  }
  return of_tree(type, initial_value(type, initial), 0);
}

std::string quote(std::string_view text) {
  return '"' + glb2idl::escape(text) + '"';
}

std::string wide_quoted(std::string_view utf8) {
  std::string out = "u\"";
  bool number = false;  // a digit after a numeric escape would become part of it
  for (const char16_t one : to_wide(utf8)) {
    const bool plain = one >= 0x20 && one < 0x7F && one != '"' && one != '\\' && one != '?';
    out += number && plain ? "\" u\"" : "";
    out += plain ? std::string(1, static_cast<char>(one)) : fmt::format("\\x{:04x}", static_cast<unsigned>(one));
    number = !plain;
  }
  return out + "\"";
}

std::string comment_text(std::string_view text) {
  std::string out(text);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  out.resize(out.find_last_not_of(" \\") + 1);  // g++ takes a backslash for the last character even before blanks
  return out;
}

std::string cpp_place(const Place& place, std::string_view pou) {
  Place shown = place;
  if (place.file) {  // with the folder the module would depend on where it was built
    shown.file = std::make_shared<const std::string>(place.file->substr(place.file->rfind('/') + 1));
  }
  std::string text = to_string(shown);
  if (place.within) {
    text += (text.empty() ? "" : ": ") + *place.within;
  }
  return fmt::format("{{{}, {}}}", quote(text), quote(pou));
}

std::string wrapped(const std::string& expression) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < expression.size(); ++i) {
    const char c = expression[i];
    if (c == '"' && (i == 0 || expression[i - 1] != '\\')) {
      in_text = !in_text;
    } else if (!in_text && (c == '(' || c == '[' || c == '{')) {
      ++depth;
    } else if (!in_text && (c == ')' || c == ']' || c == '}')) {
      --depth;
    } else if (!in_text && depth == 0 && c == ' ') {
      return "(" + expression + ")";
    }
  }
  return expression;
}

}  // namespace indurop::plc
