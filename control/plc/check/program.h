// SPDX-License-Identifier: Apache-2.0
// The checked meaning of a PLC project: what each name refers to, which variables are shared, and which task runs which
// programs. It is the input of the emitters.

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

#include "control/plc/check/constant.h"
#include "control/plc/check/type.h"
#include "control/plc/model/project.h"
#include "core/schema/schema.h"

namespace indurop::plc {

struct LibraryBlock;
struct LibraryFunction;
struct LibraryParameter;

// A variable that outlives the calls of POUs and belongs to none: VAR_GLOBAL, located, or declared in a .glb file.
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

// A variable of a POU. Externals refer to their global.
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
  bool called = false;      // an instance that is called, or passed as VAR_IN_OUT
  bool in_methods = false;  // a VAR_IN_OUT of a function block that its methods use
  bool aliased = false;  // also reached other than by its name in its own POU: by address, from methods, from outside
  const Pou* owner = nullptr;
};

// The parts of a global that a POU accesses: "" is the whole, ".eOpCode" a field.
struct GlobalUse {
  bool read = false;
  std::set<std::string> writes;
};

struct Pou {
  ast::Pou* tree = nullptr;
  std::string name;
  const Type* result = nullptr;  // of a function that returns a value
  const Type* type = nullptr;    // of a function block, class or interface: the type of its instances
  std::deque<Variable> variables;
  std::map<std::string, Variable*> names;  // in capitals
  std::set<const Pou*> uses;               // all that must be emitted with it
  std::set<const Pou*> holds;              // those of them whose variables are inside it
  std::set<const Pou*> calls;              // those of them that it runs
  std::map<const Global*, GlobalUse> globals;
  std::set<std::string> labels;
  bool result_assigned = false;
  bool calls_blocks = false;                     // calls function blocks that need the scan
  bool points_to_own = false;                    // it takes addresses of variables that end with the call
  std::map<std::string, ast::Expression> given;  // "INSTANCE.PARAMETER", a VAR_IN_OUT, in the last call checked

  Global* instance = nullptr;  // of a program that others use by its name: its instance
  std::size_t index = 0;       // in `pous` of the program

  // Data of an instance, known when all variables are declared; see instance_sizes.h
  std::uint64_t variables_inside = 0;     // including those of inner instances, times array elements; saturates
  bool holds_places = false;              // AT %I*
  const LibraryBlock* forgets = nullptr;  // a block of which a restart keeps inputs and outputs only

  // Object orientation
  Pou* owner = nullptr;                                                 // of a method: the POU of its instances
  const Pou* base = nullptr;                                            // EXTENDS of a function block or class
  std::vector<const Pou*> interfaces;                                   // IMPLEMENTS; of an interface: EXTENDS
  std::vector<Pou*> methods;                                            // its own ones, and accessors of properties
  std::map<std::pair<ast::Accessor, std::string>, Pou*> method_names;   // first one of each name, in capitals
  mutable std::optional<std::vector<const Variable*>> parameters = {};  // see parameters_of()
  std::vector<const Pou*> ancestors;  // all POUs it extends and implements, each once, after its own ancestors
  bool is_object = false;             // has methods, or is related to POUs that have
  const Pou* replaces = nullptr;      // of a method: the inherited one that it overrides
  bool called_unseen = false;         // of a method: a call may reach it without naming it

  // Returns a variable of the POU, else of the instance it works on, else an inherited one.
  [[nodiscard]] Variable* find(const std::string& capitals) const;
  // Returns the POU whose methods it calls as its own: itself, or for a method its owner; null: there are no instances.
  [[nodiscard]] const Pou* self() const noexcept;
  // Returns "Motor.Start".
  [[nodiscard]] std::string title() const;
  [[nodiscard]] bool is_callable() const noexcept {  // its variables end with the call
    return tree->kind == ast::Pou::Kind::Function || tree->kind == ast::Pou::Kind::Method;
  }
  [[nodiscard]] bool is_block() const noexcept {
    return tree->kind == ast::Pou::Kind::FunctionBlock || tree->kind == ast::Pou::Kind::Class;
  }
};

// Returns inputs, outputs and VAR_IN_OUT, inherited ones first. Requires that all are declared.
[[nodiscard]] const std::vector<const Variable*>& parameters_of(const Pou& pou);
// Returns all variables, inherited ones first.
[[nodiscard]] std::vector<const Variable*> all_variables(const Pou& pou);
// Returns the method that a call of an instance runs: its own, else the inherited one; of interfaces and abstract
// function blocks also one without a body. Null if there is none.
[[nodiscard]] const Pou* find_method(const Pou& pou, std::string_view name,
                                     ast::Accessor accessor = ast::Accessor::None);
// Returns whether `pou` is `other`, extends it, or implements it.
[[nodiscard]] bool is_a(const Pou& pou, const Pou& other) noexcept;

// The result of checking an expression.
struct Resolved {
  enum class Meaning : std::uint8_t { Value, Variable, Global, FunctionResult, Type, Namespace, This, Super };
  Meaning meaning = Meaning::Value;
  Variable* variable = nullptr;
  const Global* global = nullptr;
  std::string path;                  // Namespace: "knu::Robot"
  std::optional<Constant> constant;  // set if the value is known
  bool untyped = false;              // a number without a type takes the one that its context requires
  const Type* operand = nullptr;     // Binary: the common type of both sides
  bool is_output = false;            // Member of an instance: one of its outputs

  // Fields of a Call
  enum class Intrinsic : std::uint8_t { None, Address, Size, IsValid, LowerBound, UpperBound };
  Intrinsic intrinsic = Intrinsic::None;      // ADR() and REF(), SIZEOF(), __ISVALIDREF()
  bool by_super = false;                      // of a method: exactly this one, without dynamic dispatch
  bool settled = false;                       // a call that is not checked again when the expression around it is
  bool cast = false;                          // converts its only argument to the type of the call; made by the checker
  const LibraryFunction* function = nullptr;  // library function called, or implementing an operator
  const Pou* pou = nullptr;
  struct Actual {
    const ast::Argument* argument = nullptr;  // null: omitted
    const Type* type = nullptr;               // of the parameter
    const Variable* parameter = nullptr;      // of a POU
    std::string member;                       // member of the struct of a function block
  };
  std::vector<Actual> actuals;            // library functions: inputs by position; others: as declared
  const ast::Argument* enable = nullptr;  // EN
  const ast::Argument* enable_out = nullptr;
};

// The variable that a path outside of POUs leads to: resource.program.instance.list[3]
struct Reached {
  struct Step {  // one part of the path; one of these is set
    const Variable* variable = nullptr;
    const Field* field = nullptr;
    const LibraryParameter* pin = nullptr;
    std::vector<std::uint64_t> index = {};  // from 0
  };
  const Global* global = nullptr;  // null: a variable of a program
  const Pou* program = nullptr;
  const ProgramInstance* instance = nullptr;  // null: of a program without configuration, or of all instances
  std::vector<Step> steps;
  const Type* type = nullptr;
  bool constant = false;
  bool input = false;  // %I
};

// VAR_ACCESS: a shared variable that follows another variable.
struct AccessPath {
  Place at;
  std::string name;
  const Type* type = nullptr;
  bool writable = false;
  bool of_each_instance = false;  // declared in the program
  Reached to;
};

// An input or output that a configuration connects with a global variable, or an input to which it gives a value.
struct ConnectedPin {
  const Variable* parameter = nullptr;
  Reached other;
  const ast::Initial* value = nullptr;
};

// Types of .glb files and values of their enumerations by their names in capitals: "PRESS.MODE" and "MODE". Null: the
// name is ambiguous.
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
  const ProgramInstance* declared = nullptr;  // null: declared by no configuration
  std::uint64_t text = 0;                     // hash of the files: changes with their text
};

// The plan of one module.
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
  ForeignNames foreign_names;                                  // names of `foreign`
  std::map<const schema::Variable*, Global*> foreign_globals;  // those in use
  std::map<std::string, const Type*> foreign_types;            // those in use, by full name
  std::map<std::pair<std::string, std::string>, std::pair<const Type*, std::int64_t>> enum_values;  // by type and name
  std::map<std::string, std::vector<const Type*>> enums_of_value;  // the first two types that have the value
  std::size_t indexed_types = 0;                                   // of `named_types`, in these two maps
  std::deque<Type*> named_types;                                   // types of the project, each after those it contains
  std::uint64_t fields = 0;                                        // of all types and variables, see kMaxFields
  std::uint64_t values = 0;                                        // initial values of variables, see count_values()
  std::map<std::string, const Type*> type_names;
  std::deque<Global> globals;
  std::map<std::string, Global*> global_names;
  std::set<std::string> shared_names;                   // of globals other than Foreign, no namespace, in capitals
  std::map<std::string, Global*> addresses;             // "%IX0.0"
  std::map<std::string, std::map<int, Global*>> areas;  // "%IX0." and the last number: globals at addresses
  std::deque<Pou> pous;
  std::map<std::string, Pou*> pou_names;
  std::map<std::string, const ast::Pou*> generic_functions;  // with inputs such as ANY_NUM, in capitals
  std::deque<ast::Pou> made_functions;                       // made from generic ones for the types of the calls
  std::map<std::string, const Global*> placed;  // where VAR_CONFIG puts AT %I* of instances: "MAIN_MOTOR_RUNNING"
  std::map<const Global*, const Pou*> starts;   // functions that run the starts of instances in globals
  std::vector<AccessPath> accesses;
  std::map<const ProgramInstance*, std::vector<ConnectedPin>> connections;
  bool types_known = false;
  bool has_objects = false;                                     // classes, interfaces, methods
  std::vector<std::pair<Type*, ast::TypeSpec*>> open_pointers;  // pointers to types declared later
  std::vector<const Pou*> order;                                // each after those it uses
  std::vector<TaskPlan> tasks;
  bool library = false;            // a PROGRAM is not required
  bool infinite_division = false;  // a REAL divided by zero is infinite or NaN
  std::string space;               // namespace of the shared variables
};

}  // namespace indurop::plc
