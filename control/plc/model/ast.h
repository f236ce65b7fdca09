// SPDX-License-Identifier: Apache-2.0
// The common syntax tree of all languages of IEC 61131-3: expressions, statements, types, declarations. Names are as
// written and not yet resolved. Fields marked "checker" are empty until the program was checked.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "control/plc/model/elementary.h"
#include "control/plc/model/source_place.h"

namespace indurop::plc {
struct Type;      // resolved type, see control/plc/check/type.h
struct Resolved;  // meaning of a name, see control/plc/check/program.h
}  // namespace indurop::plc

namespace indurop::plc::ast {

// Trees are walked recursively: readers build none deeper than this. (A chain a + b + c... has one level per operator.)
inline constexpr int kMaxDepth = 400;

// %IX0.3, %QW2, %MD4. The size is X if no letter is written.
struct DirectAddress {
  char area = 'I';           // I Q M
  char size = 'X';           // X B W D L
  std::vector<int> numbers;  // {0, 3}; none: %I*
};
// "%IX0.3"
[[nodiscard]] std::string to_string(const DirectAddress& address);

// bool: BOOL. uint64: integers and bit strings, a sign is a unary minus. int64: nanoseconds of TIME and TIME_OF_DAY,
// nanoseconds since 1970 of DATE and DATE_AND_TIME. string: decoded, without quotes.
using LiteralValue = std::variant<bool, std::uint64_t, double, std::int64_t, std::string>;

enum class Operator : std::uint8_t {
  None,
  Not,
  Negate,
  Plus,  // unary, no effect
  Power,
  Multiply,
  Divide,
  Modulo,
  Add,
  Subtract,
  Less,
  Greater,
  LessEqual,
  GreaterEqual,
  Equal,
  NotEqual,
  And,
  Xor,
  Or,
};

struct Argument;

struct Expression {
  enum class Kind : std::uint8_t {
    Literal,
    Name,    // name
    Direct,  // address
    Member,  // operands[0].name; also Enum#Value, namespace.variable, instance.output, step.X
    Bit,     // operands[0].bit, w.3; also w.%B1, the `width` bits starting at `bit`
    Index,   // operands[0][operands[1], operands[2], ...]
    Deref,   // operands[0]^, THIS^ and SUPER^ too
    Call,    // operands[0](arguments): a function, or in a statement an instance of a function block
    Unary,   // op operands[0]
    Binary,  // operands[0] op operands[1]
  };
  Kind kind = Kind::Literal;
  Operator op = Operator::None;
  Place at;
  std::string name;                      // Name, Member; as written. Call: the type that a drawn block names
  LiteralValue value;                    // Literal
  std::optional<Elementary> value_type;  // Literal: T#, D#, 'text' and INT#5 have one, 5 and 1.5 have none
  std::string value_enum;                // Name: the type in Color#Red
  bool guards = false;                   // Binary: the right side of AND is the condition of a transition
  bool of_this = false;                  // Name: written as THIS^.x, a variable of the instance
  bool as_truth = false;                 // at a contact or coil: a number of a .glb is used as a BOOL, 0 is FALSE
  unsigned bit = 0;
  unsigned width = 1;
  DirectAddress address;
  std::vector<Expression> operands;
  std::vector<Argument> arguments;  // Call

  // Set by the checker
  const Type* type = nullptr;
  std::shared_ptr<Resolved> resolved;
};

// name := value, name => variable, NOT name => variable, or only a value. EN and ENO are ordinary arguments here.
struct Argument {
  Place at;
  std::string name;  // empty: by position
  bool output = false;
  bool negated = false;             // NOT name => variable
  std::optional<Expression> value;  // none: IN := , (written by some editors)
};

struct Statement;
using Body = std::vector<Statement>;

struct CaseLabel {
  Expression low;
  std::optional<Expression> high;  // low..high
};

// One arm of IF or CASE.
struct Branch {
  Place at;
  std::optional<Expression> condition;  // IF, ELSIF; none: ELSE
  std::vector<CaseLabel> labels;        // CASE; none: ELSE
  Body body;
};

struct Statement {
  enum class Kind : std::uint8_t {
    Empty,   // only a comment
    Assign,  // target := value
    Call,    // value is Expression::Kind::Call
    If,      // branches
    Case,    // value, branches
    For,     // target := value TO to BY by DO body
    While,   // value, body
    Repeat,  // body, UNTIL value
    Exit,
    Continue,
    Return,  // only if value is true, where it is set
    Label,   // label; only in the outermost list of a body
    Jump,    // to label; only if value is true, where it is set
  };
  Kind kind = Kind::Empty;
  Place at;
  std::string comment;  // written to the generated code
  std::optional<Expression> target;
  std::optional<Expression> value;
  std::optional<Expression> to;
  std::optional<Expression> by;
  std::vector<Branch> branches;
  Body body;
  std::string label;
  bool binds = false;     // Assign: target REF= value
  bool attempts = false;  // Assign: target ?= value
};

struct Initial;

// An element of [1, 2, 3(0)] or a field of (x := 1, y := 2).
struct InitialElement;

struct Initial {
  enum class Kind : std::uint8_t { Value, Array, Struct };
  Kind kind = Kind::Value;
  Place at;
  std::optional<Expression> value;  // Value
  std::vector<InitialElement> elements;
};

struct InitialElement {
  std::string field;                // Struct
  std::optional<Expression> count;  // Array: 3(0)
  Initial value;
};

// The arguments of FB_Init in the declaration of an instance: fb : Motor(5, speed := 3).
using StartArguments = std::vector<Argument>;

struct Dimension {
  Expression low;
  Expression high;
};

struct Variable;

struct EnumValue {
  Place at;
  std::string name;
  std::optional<Expression> value;
};

// POINTER TO (of CODESYS) types convert to each other, REF_TO (of the standard) do not; a REFERENCE TO is dereferenced
// automatically.
enum class PointerKind : std::uint8_t { PointerTo, RefTo, ReferenceTo };

struct TypeSpec {
  enum class Kind : std::uint8_t {
    Elementary,
    String,    // length; none: 80
    Named,     // name: a user-defined type, a function block
    Array,     // dimensions, element
    Subrange,  // elementary (range.low..range.high)
    Struct,    // fields
    Pointer,   // POINTER TO element, or as `pointer` says
    Enum,      // values; of type `elementary` if it is set, else INT
    Inferred,  // VAR_TEMP of translated networks: that of the first value assigned in the text of the body; also what
               // a declaration with an error declares
  };
  Kind kind = Kind::Elementary;
  Place at;
  Elementary elementary = Elementary::Int;
  std::string name;
  std::vector<StartArguments> starts;  // Named: for all instances, or one for each element of the surrounding array
  std::optional<Expression> length;
  std::vector<Dimension> dimensions;
  std::shared_ptr<TypeSpec> element;  // Array, Pointer; the base of a Struct
  PointerKind pointer = PointerKind::PointerTo;
  std::optional<Dimension> range;
  std::vector<Variable> fields;
  bool overlaps = false;  // Struct: a UNION, whose fields share their memory
  bool open = false;      // Array: [*], the dimensions have no bounds
  std::vector<EnumValue> values;
};

enum class Section : std::uint8_t { Local, Input, Output, InOut, Temp, Global, External };
enum class Edge : std::uint8_t { None, Rising, Falling };  // BOOL R_EDGE, BOOL F_EDGE
enum class Access : std::uint8_t { Public, Internal, Protected, Private };

struct Variable {
  Section section = Section::Local;
  Place at;
  std::string name;
  TypeSpec type;
  std::optional<Initial> initial;
  std::optional<DirectAddress> address;  // AT %IX0.0; then the name may be empty
  bool constant = false;
  bool retain = false;
  bool non_retain = false;       // also where the surrounding instance is RETAIN
  bool is_static = false;        // VAR_STAT: one for all instances, or of a function: kept between calls
  bool of_instance = false;      // VAR_INST of a method: kept in the instance
  bool made = false;             // made for a drawing or a list, not in the text
  std::optional<Access> access;  // VAR PUBLIC
  Edge edge = Edge::None;
  std::string comment;
  std::optional<Expression> late;  // checker: the initial value, if it is known at run time only
};

// The name of another declaration, and the place that refers to it.
struct NameAt {
  Place at;
  std::string name;
};

// NAMESPACE A.B, and the names in its USING.
struct Scope {
  std::string space;
  std::vector<NameAt> uses;
};

// TYPE name : type := initial; END_TYPE
struct TypeDeclaration {
  Place at;
  std::string name;
  TypeSpec type;
  std::optional<Initial> initial;
  std::string comment;
  Scope scope;
};

// The accessors of a PROPERTY; both are methods with its name.
enum class Accessor : std::uint8_t { None, Get, Set };

struct Pou {
  enum class Kind : std::uint8_t { Program, Function, FunctionBlock, Class, Interface, Method };
  Kind kind = Kind::Program;
  Place at;
  std::string name;
  std::string comment;
  std::optional<TypeSpec> result;  // Function, Method
  std::vector<Variable> variables;
  Body body;
  Scope scope;

  // Fields of FunctionBlock, Class, Interface, Method
  bool is_abstract = false;
  bool is_final = false;
  bool overrides = false;  // METHOD OVERRIDE
  bool is_struct = false;  // Class: a STRUCT that contains function blocks
  bool is_action = false;  // Method: an ACTION that other POUs call
  Access access = Access::Public;
  Accessor accessor = Accessor::None;
  std::vector<NameAt> bases;       // EXTENDS; an interface can have several
  std::vector<NameAt> interfaces;  // IMPLEMENTS
  std::vector<Pou> methods;

  std::vector<Pou> actions;     // as methods, for those that other POUs call: x.Restart();
  std::optional<Place> c_code;  // it has C code that is not supported, so it is left out
};

}  // namespace indurop::plc::ast
