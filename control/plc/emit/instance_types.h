// SPDX-License-Identifier: Apache-2.0
// The types of the programs and function block instances that a module built with --watch reports, with the place of
// each variable in an instance: once for each type, however many instances there are.

#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "control/plc/check/program.h"

namespace indurop::plc {

inline constexpr std::size_t kNoType = std::numeric_limits<std::size_t>::max();

struct InstanceVariable {
  std::string name;
  ast::Section section = ast::Section::Local;
  const Type* type = nullptr;
  const Variable* variable = nullptr;  // null: a pin of a library function block, or a global that is used by its name
  const Global* global = nullptr;      // the variable that it stands for, which other programs see, too
  std::size_t of = kNoType;            // an instance, or an array of them: its InstanceType
  std::optional<std::size_t> offset = {};  // from the begin of the instance, in bytes; none: it is not reported
  bool step = false;                       // of a chart
};

struct InstanceType {
  std::string name;
  const Pou* pou = nullptr;  // null: a library function block
  std::size_t base = kNoType;
  std::size_t bytes = 0;                    // of an instance, including those of its base
  std::vector<InstanceVariable> variables;  // without those of the base
};

struct InstanceTypes {
  std::vector<InstanceType> types;    // each after those that it contains or extends
  std::vector<std::size_t> programs;  // the types of `programs`, in their order
};

// The values of a program's instance begin here in its WatchLayout.
inline constexpr std::size_t kInstanceBegin = 8;

// Returns the types of these programs and of all instances in them. Variables that the compiler has added are left out.
[[nodiscard]] InstanceTypes instance_types(const std::vector<const TaskProgram*>& programs);

}  // namespace indurop::plc
