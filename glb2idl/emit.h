// SPDX-License-Identifier: Apache-2.0
// The outputs for a checked program, as texts. No function here accesses the file system.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "glb2idl/program.h"

namespace indurop::glb2idl {

struct Output {
  std::string path;  // relative to the output folder
  std::string text;
};

// Returns <stem>.idl: OMG IDL for idlc and other vendors' compilers.
[[nodiscard]] std::string emit_idl(const Program& program, const GlbFile& unit);

// <stem>.glb.h of each unit: the variables as C++ shapes. It includes the headers of included files.
struct Header {
  // Namespace of generated details. Its name depends on the header's content, so that two modules built from different
  // texts share no symbol by accident.
  std::string hidden;
  std::string text;
};
[[nodiscard]] std::vector<Header> emit_cpp(const Program& program);

// Returns <stem>.layout.txt: sizes and offsets, for people.
[[nodiscard]] std::string emit_layout(const Program& program, const GlbFile& unit);

// Returns all of these for all units, with indurop/generated.h last.
[[nodiscard]] std::vector<Output> emit_all(const Program& program);

// Packages of ROS 2 messages with the same layout, one folder each. `problems`: all names that are invalid in ROS 2.
struct RosPackages {
  std::vector<Output> outputs;
  std::vector<base::Diagnostic> problems;
};
[[nodiscard]] RosPackages emit_ros2(const Program& program);

// Returns the variables for modules in C: <stem>.glb.c.h of each unit, with indurop/generated.c.h last.
[[nodiscard]] std::vector<Output> emit_c(const Program& program);

// Returns a Python module with the types of all variables, for type checkers.
[[nodiscard]] std::string emit_python(const Program& program);

// Returns a value of `type` at `bytes` as a C++ initialiser: 5, 0.5, {{1, 2}}, enum values by name.
[[nodiscard]] std::string initializer_text(const schema::Type& type, const std::uint8_t* bytes);
// Returns the C++ type of values: std::uint32_t, ::knu::Robot::joints_t, std::array<double, 6>.
[[nodiscard]] std::string cpp_type(const schema::Type& type);

}  // namespace indurop::glb2idl
