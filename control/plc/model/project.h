// SPDX-License-Identifier: Apache-2.0
// A whole PLC project as returned by the readers: types, program organisation units, and the assignment of programs to
// tasks.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "control/plc/model/ast.h"
#include "control/plc/model/dialect.h"

namespace indurop::plc {

// The maximum length of a chain of EXTENDS; more is an error, because inherited items are copied.
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

// input := variable, output => variable, of a program instance.
struct Connection {
  Place at;
  std::string parameter;
  bool output = false;
  ast::Expression value;
  std::optional<ast::Initial> initial;  // checker: the value, if it is not a variable
};

// PROGRAM instance WITH task : type (input := variable)
struct ProgramInstance {
  Place at;
  std::string name;
  std::string task;  // empty: the default task
  std::string type;
  std::vector<Connection> connections = {};
};

// An entry of VAR_ACCESS: pressure : plc.main.tank.pressure : REAL READ_WRITE; for an address the resource is left out.
struct Access {
  Place at;
  std::string name;
  std::string program;  // PROGRAM that declares it; empty: a configuration
  ast::Expression to;
  ast::TypeSpec type;
  bool writable = false;
};

// An entry of VAR_CONFIG: plc.main.motor.running AT %QX1.0 : BOOL := TRUE;
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
  std::vector<ast::NameAt> left_out;      // POUs with C code, and its places
  bool incomplete = false;                // unsupported parts were left out, so names may be missing
  Dialect dialect = Dialect::Iec;         // of the editor that wrote it, if the files identify it
  std::size_t copied_actions = 0;         // approximate bytes of actions copied to their callers
  std::vector<std::string> global_lists;  // names that qualify globals: Io.Blocked, in CODESYS
};

// Returns "; it was left out, ..." for a POU left out because of C code, "" for others.
[[nodiscard]] std::string why_left_out(const Project& project, const std::string& name);

// Appends everything in `from`, in its order. The checker finds duplicates.
void append(Project& into, Project from);

}  // namespace indurop::plc
