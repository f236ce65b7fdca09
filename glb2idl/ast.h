// SPDX-License-Identifier: Apache-2.0
// Syntax tree of one .glb file: names are not resolved, nothing is computed.

#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/schema/schema.h"
#include "glb2idl/source.h"

namespace indurop::glb2idl::ast {

struct Name {
  std::string text;
  Span at;
};

// a.b.c or a::b::c
struct Path {
  std::vector<std::string> parts;
  Span at;
};

struct Expression {
  enum class Kind { Number, Text, Character, Bool, Path, Unary, Binary, Conditional };
  Kind kind = Kind::Number;
  Span at;
  std::string spelling;  // Number: with its suffix or unit; Text, Character: decoded; Bool, Unary, Binary: the word
  Path path;
  std::vector<Expression> operands;
};

// One value, or a list in braces.
struct Initializer {
  Span at;
  std::optional<Expression> value;
  std::vector<Initializer> list;
};

struct Annotation {
  Name name;
  Span at;
  std::vector<Initializer> arguments;
};

struct Dimension {
  Span at;
  std::optional<Expression> size;  // none: []
};

struct Declaration;
struct StructBody;
struct EnumBody;

struct TypeSpec {
  enum class Kind { Base, Void, Named, Struct, Enum };
  Kind kind = Kind::Base;
  Span at;
  schema::Base base = schema::Base::Int32;
  Path path;                // Named
  std::optional<Name> tag;  // Struct, Enum: the name after the keyword
  std::shared_ptr<const StructBody> structure;
  std::shared_ptr<const EnumBody> enumeration;
};

struct Parameter;

struct Declarator {
  Name name;
  std::vector<Dimension> dims;
  std::optional<Initializer> initial;
  std::vector<Annotation> annotations;
  bool is_function = false;
  std::vector<Parameter> parameters;
  std::optional<Expression> deadline;
};

struct Parameter {
  TypeSpec type;
  Declarator declarator;  // the name may be empty
};

struct Declaration {
  enum class Kind { Plain, Typedef, Constant };
  Kind kind = Kind::Plain;
  Span at;
  TypeSpec type;
  std::vector<Declarator> declarators;
  std::vector<Annotation> annotations;  // before the type: for all declarators
  std::string description;              // from the comment
};

struct StructBody {
  std::vector<Declaration> fields;
};

struct EnumBody {
  struct Item {
    Name name;
    std::optional<Expression> value;
  };
  std::vector<Item> items;
};

struct Namespace {
  Path path;
};

struct Include {
  Span at;
  std::string path;
};

struct Define {
  Name name;
  Expression value;
  std::string description;
};

// "pool" in front of a declaration.
struct Pool {
  Declaration declaration;
};

using Item = std::variant<Namespace, Include, Define, Declaration, Pool>;

struct File {
  std::vector<Item> items;
  std::set<std::string> broken;  // names in parts that could not be parsed: not reported if they are missing later
};

}  // namespace indurop::glb2idl::ast
