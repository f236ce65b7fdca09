// SPDX-License-Identifier: Apache-2.0
// The parts of a shared variable that an FMU shows one by one: numbers, bools, texts and enumerators.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::fmi {

struct ShownPart {
  std::string name;                    // "knu::Robot::joints[1].y"
  const schema::Type* type = nullptr;  // its dimensions are those of the array that it is an element of
  std::uint32_t offset = 0;
  std::string unit;  // those of the innermost declaration that has one
  std::string description;
  std::optional<schema::Range> range;
};

// Returns the number of parts, without making them.
std::uint64_t count_parts(const schema::Type& type);
// Calls `use` with each part, in the order of the memory.
void for_each_part(const schema::Variable& variable, const std::function<void(ShownPart)>& use);

}  // namespace indurop::fmi
