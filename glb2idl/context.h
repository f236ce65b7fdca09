// SPDX-License-Identifier: Apache-2.0
// State that the parts of the checker share while they check one file.

#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>

#include "glb2idl/ast.h"
#include "glb2idl/diagnostics.h"
#include "glb2idl/program.h"
#include "glb2idl/scope.h"

namespace indurop::glb2idl {

// Limits that real files do not reach and that protect memory from hostile ones.
inline constexpr std::uint64_t kMaxVariableBytes = std::uint64_t{256} << 20U;
inline constexpr std::uint64_t kMaxInitialBytes = std::uint64_t{1} << 20U;  // of a variable with an initial value
inline constexpr std::uint64_t kMaxCallBytes = std::uint64_t{64} << 10U;    // arguments or result of a function
inline constexpr std::uint64_t kMaxTotalInitialBytes = std::uint64_t{16} << 20U;
inline constexpr std::size_t kMaxDims = 8;
inline constexpr std::size_t kMaxStructDepth = 16;
inline constexpr std::size_t kMaxTypeParts = 20'000;    // fields and enum values in one type, including inner types
inline constexpr std::size_t kMaxTotalParts = 400'000;  // the same, summed over all types and variables

struct Context {
  const Sources& sources;
  Diagnostics& diagnostics;
  Scope& scope;
  Program& program;
  std::set<std::string> field_names{};         // of all structs: not allowed as names of C macros
  std::set<std::string> program_namespaces{};  // full names
  std::uint64_t total_initial = 0;             // bytes of initial and fallback values
  std::size_t total_parts = 0;                 // parts of all variables and functions
  std::set<std::string> broken{};              // names in parts that could not be parsed
  std::uint32_t file = 0;
  std::size_t unit = 0;
  std::string current{};  // namespace, "knu::Robot"

  void error(Span at, std::string text) { diagnostics.error(at, std::move(text)); }
  void add(Item item) { program.units[unit].items.push_back(std::move(item)); }
  [[nodiscard]] std::string full(std::string_view name) const { return qualified(current, name); }

  // Returns "knuRobot.glb:3", for descriptions.
  [[nodiscard]] std::string source(const ast::Name& name) const;
  // Returns false with a message if the name cannot be used.
  bool check_name(const ast::Name& name, NameRole role);
  // Declares `name` in the current namespace.
  bool declare(const ast::Name& name, Symbol::Kind kind);

  [[nodiscard]] std::optional<Value> constant(const ast::Path& path);
  [[nodiscard]] std::optional<Value> evaluate(const ast::Expression& expression);
  // Returns true for an unknown name that may belong to a declaration with an error; it needs no further message.
  [[nodiscard]] bool is_broken(const ast::Path& path) const { return broken.contains(path.parts.front()); }
};

}  // namespace indurop::glb2idl
