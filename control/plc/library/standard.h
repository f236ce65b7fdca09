// SPDX-License-Identifier: Apache-2.0
// The standard functions and function blocks for the checker of PLC programs: parameters, types, and the C++ name (in
// namespace indurop::iec, written as iec::) that the generated code calls. include/indurop/plc/ implements them.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "control/plc/model/elementary.h"

namespace indurop::plc {

// The generic types of the standard. ANY includes user-defined types, the others only elementary ones.
enum class Generic : std::uint8_t { Any, AnyElementary, AnyNum, AnyInt, AnyReal, AnyBit };

// In one call all parameters of the same generic type have one common type; a generic result has it too.
using LibraryType = std::variant<Elementary, Generic>;

[[nodiscard]] std::string_view name_of(Generic type) noexcept;
[[nodiscard]] bool accepts(LibraryType parameter, Elementary type) noexcept;

struct LibraryParameter {
  std::string name;   // "IN1"
  std::string alias;  // other name used by editors: RESET for R; else empty
  LibraryType type = Generic::Any;
  std::string cpp;  // member of the struct of a function block
};

struct LibraryFunction {
  std::string name;
  std::vector<LibraryParameter> inputs;
  bool extensible = false;  // the last input may be repeated any number of times: IN2, IN3, ...
  LibraryType result = Generic::Any;
  std::string cpp;      // "iec::add", "iec::to<std::int16_t>"
  bool faults = false;  // its first C++ argument is the iec::Place to report in a fault
  bool joins = false;   // "iec::concat_as<T>" gives the text as a T

  // Returns the position of the input of this name, in any case; an extensible function has any number of inputs.
  [[nodiscard]] std::optional<std::size_t> position(std::string_view input) const;
  // Returns the input at the position; requires that there is one.
  [[nodiscard]] const LibraryParameter& input(std::size_t position) const;
};

// A function block: its struct has a member for each parameter and is evaluated by block(scan).
struct LibraryBlock {
  std::string name;
  std::vector<LibraryParameter> inputs;
  std::vector<LibraryParameter> outputs;
  std::string cpp;  // "iec::Ton", "iec::Ctu<std::int16_t>"

  // Finds an input by name or alias in any case; null if there is none.
  [[nodiscard]] const LibraryParameter* input(std::string_view wanted) const;
  [[nodiscard]] const LibraryParameter* output(std::string_view wanted) const;
};

// Returns all functions; overloads of one name are adjacent.
[[nodiscard]] const std::vector<LibraryFunction>& library_functions();
[[nodiscard]] const std::vector<LibraryBlock>& library_blocks();

// Returns all overloads of the name, in any case; none if it is no standard function. TOD_TO_STRING is
// TIME_OF_DAY_TO_STRING.
[[nodiscard]] std::vector<const LibraryFunction*> find_functions(std::string_view name);
// Finds a function block. "@TON" always is the standard one: no program can declare a block of that name.
[[nodiscard]] const LibraryBlock* find_block(std::string_view name);

// Returns "std::int16_t", "iec::Time". Requires a type other than STRING and WSTRING, whose C++ type depends on their
// length.
[[nodiscard]] std::string_view cpp_type(Elementary type) noexcept;

// Returns "LEN" for "Standard.LEN", as projects of CODESYS and TwinCAT may name the library; "" for other names.
[[nodiscard]] std::string_view name_in_standard(std::string_view path) noexcept;

}  // namespace indurop::plc
