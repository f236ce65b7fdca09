// SPDX-License-Identifier: Apache-2.0
// A whole PLC project as the readers find it: types, program organisation units, and which program runs when.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plc/model/ast.h"
#include "plc/model/dialect.h"

namespace indurop::plc {

// More of them in one line are an error: what is inherited is copied.
inline constexpr std::size_t kMaxExtends = 64;

// TASK fast (INTERVAL := T#10ms, PRIORITY := 1)
inline constexpr std::int64_t kDefaultIntervalNs = 10'000'000;

struct Task {
  Place at;
  std::string name;
  std::optional<std::int64_t> interval_ns;  // none: the default period
  std::optional<std::int32_t> priority;
  std::string single;  // SINGLE := variable or "%IX0.0": runs at its rising edge
};

// input := variable, output => variable, of a program's instance.
struct Connection {
  Place at;
  std::string parameter;
  bool output = false;
  ast::Expression value;
  std::optional<ast::Initial> initial;  // checker: the value, where it is no variable
};

// PROGRAM instance WITH task : type (input := variable)
struct ProgramInstance {
  Place at;
  std::string name;
  std::string task;  // empty: the default task
  std::string type;
  std::vector<Connection> connections = {};
};

// Of VAR_ACCESS: pressure : plc.main.tank.pressure : REAL READ_WRITE; of an address the resource is left out.
struct Access {
  Place at;
  std::string name;
  std::string program;  // the PROGRAM in which it is declared; empty: a configuration
  ast::Expression to;
  ast::TypeSpec type;
  bool writable = false;
};

// Of VAR_CONFIG: plc.main.motor.running AT %QX1.0 : BOOL := TRUE;
struct Configured {
  Place at;
  std::vector<std::string> path;
  std::optional<ast::DirectAddress> address;
  ast::TypeSpec type;
  std::optional<ast::Initial> initial;
};

struct Resource {
  Place at;
  std::string name;
  std::vector<ast::Variable> globals;
  std::vector<Task> tasks;
  std::vector<ProgramInstance> programs;
};

struct Configuration {
  Place at;
  std::string name;
  std::vector<ast::Variable> globals;
  std::vector<Resource> resources;
};

struct Project {
  std::vector<ast::TypeDeclaration> types;
  std::vector<ast::Pou> pous;
  std::vector<ast::Variable> globals;  // VAR_GLOBAL outside of configurations
  std::vector<Configuration> configurations;
  std::vector<Configured> configured;
  std::vector<Access> accesses;
  std::vector<ast::NameAt> left_out;      // POUs with C code, and where that stands
  bool incomplete = false;                // something that is not supported was left out, so that names may miss
  Dialect dialect = Dialect::Iec;         // of the editor that wrote it, as far as the files say
  std::size_t copied_actions = 0;         // bytes of actions that were copied to where they are called, about
  std::vector<std::string> global_lists;  // names through which globals may be reached: Io.Blocked, as CODESYS has it
};

// "; it was left out, ..." of a POU that C code kept out, "" of others.
[[nodiscard]] std::string why_left_out(const Project& project, const std::string& name);

// Appends everything in `from`, in its order. Doubles are for the checker to find.
void append(Project& into, Project from);

}  // namespace indurop::plc
