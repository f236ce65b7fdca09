// SPDX-License-Identifier: Apache-2.0
// The checked meaning of a PLC project: what every name stands for, what is shared, which task runs what. Input of the
// emitters.

#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plc/check/constant.h"
#include "plc/check/type.h"
#include "plc/model/project.h"
#include "schema/schema.h"

namespace indurop::plc {

struct LibraryBlock;
struct LibraryFunction;
struct LibraryParameter;

// A variable that outlives its POU's call and is not the POU's own: VAR_GLOBAL, located, or declared in a .glb file.
struct Global {
  enum class Kind : std::uint8_t {
    Fixed,    // CONSTANT
    Own,      // becomes a shared variable in the .glb that the compiler writes
    Foreign,  // a shared variable of another .glb
    Private,  // cannot be shared (function blocks): belongs to the one task that uses it
  };
  Kind kind = Kind::Own;
  Place at;
  std::string name;
  std::string shared_name;  // Own, Foreign: "main::I0"
  const Type* type = nullptr;
  const schema::Variable* foreign = nullptr;
  const ast::Initial* initial = nullptr;
  std::optional<Constant> constant;
  std::string address;  // "%IX0.0"
  bool retain = false;
  std::string comment;
};

struct Pou;

// A variable of a POU. Externals stand for their global.
struct Variable {
  const ast::Variable* declared = nullptr;
  ast::Section section = ast::Section::Local;
  std::string name;
  const Type* type = nullptr;
  const Global* global = nullptr;    // VAR_EXTERNAL, located variables
  std::optional<Constant> constant;  // CONSTANT of an elementary type
  bool is_constant = false;
  bool retain = false;
  bool used = false;
  bool written = false;
  bool called = false;      // an instance, or passed as VAR_IN_OUT
  bool in_methods = false;  // a VAR_IN_OUT of a function block that its methods use
  bool aliased =
      false;  // also reached otherwise than by its name in its own POU: by address, from methods, from outside
  const Pou* owner = nullptr;
};

// Which parts of a global a POU touches: "" is the whole, ".eOpCode" a field.
struct GlobalUse {
  bool read = false;
  std::set<std::string> writes;
};

struct Pou {
  ast::Pou* tree = nullptr;
  std::string name;
  const Type* result = nullptr;  // of a function that has one
  const Type* type = nullptr;    // of a function block, class or interface, the type of its instances
  std::deque<Variable> variables;
  std::map<std::string, Variable*> names;  // in capitals
  std::set<const Pou*> uses;               // all that has to be written with it
  std::set<const Pou*> holds;              // of them those whose variables lie in it
  std::set<const Pou*> calls;              // of them those it runs
  std::map<const Global*, GlobalUse> globals;
  std::set<std::string> labels;
  bool result_assigned = false;
  bool calls_blocks = false;                     // which need to know the scan
  bool points_to_own = false;                    // there are addresses of variables that end with the call
  std::map<std::string, ast::Expression> given;  // "INSTANCE.PARAMETER", a VAR_IN_OUT, in the last call checked

  Global* instance = nullptr;  // of a program that others use by its name: that one
  std::size_t index = 0;       // in `pous` of the program

  // Of an instance, when all variables are known; see instance_sizes.h
  std::uint64_t variables_inside = 0;     // with those of inner instances, each of an array; saturates
  bool holds_places = false;              // AT %I*
  const LibraryBlock* forgets = nullptr;  // one of which only inputs and outputs are kept over a restart

  // Object orientation
  Pou* owner = nullptr;                                                 // of a method: whose instances it works on
  const Pou* base = nullptr;                                            // EXTENDS of a function block or class
  std::vector<const Pou*> interfaces;                                   // IMPLEMENTS; of an interface: EXTENDS
  std::vector<Pou*> methods;                                            // and accessors of properties, its own
  std::map<std::pair<ast::Accessor, std::string>, Pou*> method_names;   // the first of each name, in capitals
  mutable std::optional<std::vector<const Variable*>> parameters = {};  // see parameters_of()
  std::vector<const Pou*> ancestors;  // all that it extends and implements, each once, behind its own ancestors
  bool is_object = false;             // has methods, or something to do with such ones
  const Pou* replaces = nullptr;      // of a method: the inherited one it overrides
  bool called_unseen = false;         // of a method: a call may not say that it is this one

  // A variable of it, else of the instance it works on, else an inherited one.
  [[nodiscard]] Variable* find(const std::string& capitals) const;
  // Whose methods are its own: itself, or of a method its owner; null: there are no instances.
  [[nodiscard]] const Pou* self() const noexcept;
  // "Motor.Start"
  [[nodiscard]] std::string title() const;
  [[nodiscard]] bool is_callable() const noexcept {  // with values that are gone when it returns
    return tree->kind == ast::Pou::Kind::Function || tree->kind == ast::Pou::Kind::Method;
  }
  [[nodiscard]] bool is_block() const noexcept {
    return tree->kind == ast::Pou::Kind::FunctionBlock || tree->kind == ast::Pou::Kind::Class;
  }
};

// Inputs, outputs and VAR_IN_OUT, inherited ones first. Requires that all are declared.
[[nodiscard]] const std::vector<const Variable*>& parameters_of(const Pou& pou);
// Inherited ones first.
[[nodiscard]] std::vector<const Variable*> all_variables(const Pou& pou);
// What a call of an instance means: its own method, else the inherited one; of interfaces and abstract function blocks
// also one that has no body. Null: there is none.
[[nodiscard]] const Pou* find_method(const Pou& pou, std::string_view name,
                                     ast::Accessor accessor = ast::Accessor::None);
// Whether it is the other one, extends it, or implements it.
[[nodiscard]] bool is_a(const Pou& pou, const Pou& other) noexcept;

// What the checker found out about an expression.
struct Resolved {
  enum class Meaning : std::uint8_t { Value, Variable, Global, FunctionResult, Type, Namespace, This, Super };
  Meaning meaning = Meaning::Value;
  Variable* variable = nullptr;
  const Global* global = nullptr;
  std::string path;                  // Namespace: "knu::Robot"
  std::optional<Constant> constant;  // the value is known
  bool untyped = false;              // a number without a type takes the one its context wants
  const Type* operand = nullptr;     // Binary: what both sides become
  bool is_output = false;            // Member of an instance: one of its outputs

  // Call
  enum class Intrinsic : std::uint8_t { None, Address, Size, IsValid, LowerBound, UpperBound };
  Intrinsic intrinsic = Intrinsic::None;      // ADR() and REF(), SIZEOF(), __ISVALIDREF()
  bool by_super = false;                      // of a method: exactly that one, whatever extends it
  bool settled = false;                       // a call that is not looked at again, because what is around it was
  bool cast = false;                          // of its only argument, to the type of the call; made by the checker
  const LibraryFunction* function = nullptr;  // of the library; also what an operator stands for
  const Pou* pou = nullptr;
  struct Actual {
    const ast::Argument* argument = nullptr;  // null: not given
    const Type* type = nullptr;               // of the parameter
    const Variable* parameter = nullptr;      // of a POU
    std::string member;                       // of a function block's struct
  };
  std::vector<Actual> actuals;            // library functions: inputs by position; others: those of the declaration
  const ast::Argument* enable = nullptr;  // EN
  const ast::Argument* enable_out = nullptr;
};

// What a path leads to that is written outside of POUs: resource.program.instance.list[3]
struct Reached {
  struct Step {  // one of them
    const Variable* variable = nullptr;
    const Field* field = nullptr;
    const LibraryParameter* pin = nullptr;
    std::vector<std::uint64_t> index = {};  // from 0
  };
  const Global* global = nullptr;  // null: a variable of a program
  const Pou* program = nullptr;
  const ProgramInstance* instance = nullptr;  // null: the program stands in no configuration, or all its instances
  std::vector<Step> steps;
  const Type* type = nullptr;
  bool constant = false;
  bool input = false;  // %I
};

// VAR_ACCESS: a shared variable that follows another one.
struct AccessPath {
  Place at;
  std::string name;
  const Type* type = nullptr;
  bool writable = false;
  bool of_each_instance = false;  // declared in the program
  Reached to;
};

// An input or output that a configuration connects: with a global variable, or an input with a value.
struct ConnectedPin {
  const Variable* parameter = nullptr;
  Reached other;
  const ast::Initial* value = nullptr;
};

// Types of .glb files and values of their enumerations by their names, in capitals: "PRESS.MODE" and "MODE". Null:
// several have the name.
struct ForeignNames {
  std::map<std::string, const schema::Variable*> variables;  // "PRESS::MODE"
  std::map<std::string, std::vector<const schema::Variable*>> last_names;
  std::set<std::string> spaces;
  std::map<std::string, const schema::Type*> types;
  std::map<std::string, const schema::Type*> values;
};

struct TaskProgram {
  std::string instance;
  const Pou* pou = nullptr;
  const ProgramInstance* declared = nullptr;  // null: no configuration does
  std::uint64_t text = 0;                     // of the files, another one for another text
};

// One module.
struct TaskPlan {
  Place at;
  std::string name;
  std::int64_t interval_ns = 0;
  std::int32_t priority = 1;
  const Global* single = nullptr;  // SINGLE: runs at its rising edge
  bool periodic = true;
  std::vector<TaskProgram> programs;
};

struct Program {
  Project project;  // the trees that everything below refers to
  TypeTable types;
  std::vector<schema::Variable> foreign;
  ForeignNames foreign_names;                                  // of them
  std::map<const schema::Variable*, Global*> foreign_globals;  // of those that are used
  std::map<std::string, const Type*> foreign_types;            // that are used, by their whole names
  std::map<std::pair<std::string, std::string>, std::pair<const Type*, std::int64_t>> enum_values;  // by type and name
  std::map<std::string, std::vector<const Type*>> enums_of_value;  // the first two that have it
  std::size_t indexed_types = 0;                                   // of `named_types`, in these two
  std::deque<Type*> named_types;                                   // of the project, each behind those it contains
  std::uint64_t fields = 0;                                        // of all types and variables, see kMaxFields
  std::uint64_t values = 0;                                        // that variables begin with, see count_values()
  std::map<std::string, const Type*> type_names;
  std::deque<Global> globals;
  std::map<std::string, Global*> global_names;
  std::set<std::string> shared_names;                   // of those that are no Foreign, without namespace, in capitals
  std::map<std::string, Global*> addresses;             // "%IX0.0"
  std::map<std::string, std::map<int, Global*>> areas;  // "%IX0." and the last number: those at addresses
  std::deque<Pou> pous;
  std::map<std::string, Pou*> pou_names;
  std::map<std::string, const ast::Pou*> generic_functions;  // with inputs such as ANY_NUM, in capitals
  std::deque<ast::Pou> made_functions;                       // of them, for the types they are called with
  std::map<std::string, const Global*> placed;  // where VAR_CONFIG puts AT %I* of instances: "MAIN_MOTOR_RUNNING"
  std::map<const Global*, const Pou*> starts;   // functions that run what their instances begin with
  std::vector<AccessPath> accesses;
  std::map<const ProgramInstance*, std::vector<ConnectedPin>> connections;
  bool types_known = false;
  bool has_objects = false;                                     // classes, interfaces, methods
  std::vector<std::pair<Type*, ast::TypeSpec*>> open_pointers;  // to types that come later
  std::vector<const Pou*> order;                                // each behind those it uses
  std::vector<TaskPlan> tasks;
  bool library = false;            // there may be no PROGRAM
  bool infinite_division = false;  // a REAL divided by zero is infinite or NaN
  std::string space;               // namespace of the shared variables
};

}  // namespace indurop::plc
