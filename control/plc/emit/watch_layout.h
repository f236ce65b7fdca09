// SPDX-License-Identifier: Apache-2.0
// The layout of the values of a program's variables in the data that a module built with --watch reports. The module
// that writes them and the view that reads them both follow it.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/check/program.h"

namespace indurop::plc {

struct WatchedVariable {
  std::string path;  // "MOTOR.DELAY.ET", in capitals
  const Type* type = nullptr;
  std::size_t offset = 0;
  std::string name;  // as it is written: "Motor.delay.ET"
};

// An instance of a function block in a program, or ("") the program itself.
struct WatchedInstance {
  std::string path;  // "MOTOR.DELAY"
  std::string name;  // as it is written: "Motor.delay"
  const Pou* pou = nullptr;
};

struct WatchLayout {
  std::string variable;    // its name in the .glb: bytes
  std::size_t bytes = 0;   // total size
  std::uint64_t mark = 0;  // the first 8 bytes: differs from that of other programs
  std::vector<WatchedVariable> variables;
  std::vector<WatchedInstance> instances;

  // Returns the variable of this path, null if there is none.
  [[nodiscard]] const WatchedVariable* find(std::string_view path) const;
};

// Returns whether a variable of a POU is reported: not temporary ones, constants, or references to other variables.
[[nodiscard]] bool is_watched(const Variable& variable);
// Returns the type of a pin of a library function block that is reported; null if it is not.
[[nodiscard]] const Type* watched_type_of(const LibraryParameter& pin);
// Returns the size of a value in bytes, without gaps.
[[nodiscard]] std::size_t packed_size(const Type& type);
[[nodiscard]] WatchLayout watch_layout(const TaskProgram& program);

// The values that a debugger sees while a body runs: those of its instance, and those of the call.
struct FrameLayout {
  std::size_t bytes = 0;
  std::vector<WatchedVariable> variables;
};
[[nodiscard]] FrameLayout frame_layout(const Pou& pou);
[[nodiscard]] FrameLayout globals_layout(const std::vector<const Global*>& globals);
// Returns the POU whose variables a body uses as its own: itself, for a method its owner; null: a function.
[[nodiscard]] const Pou* holder_of(const Pou& pou);
// Returns the variables of a call: parameters, VAR_TEMP, VAR_IN_OUT.
[[nodiscard]] std::vector<const Variable*> variables_of_call(const Pou& pou);
[[nodiscard]] bool is_result_watchable(const Pou& pou);
// Returns whether a debugger sees the global: shared ones and instances.
[[nodiscard]] bool is_global_watchable(const Global& global);

}  // namespace indurop::plc
