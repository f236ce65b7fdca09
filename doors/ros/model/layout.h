// SPDX-License-Identifier: Apache-2.0
// The bytes of a variable, from the text with which the C interface describes them ("layout" in <indurop/c.h>).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::ros {

enum class Base : std::uint8_t { Bool, Char, I8, U8, I16, U16, I32, U32, I64, U64, F32, F64, Enum, Text, Struct };

struct Field;
struct Layout {
  Base base = Base::Bool;
  std::size_t element = 0;                           // bytes of one element
  std::vector<std::size_t> dims;                     // outermost first; none: no array
  std::vector<Field> fields;                         // of a struct
  [[nodiscard]] std::size_t count() const noexcept;  // of elements
  [[nodiscard]] std::size_t size() const noexcept { return element * count(); }
};
struct Field {
  std::string name;
  std::size_t offset = 0;  // in an element
  Layout type;
};

// Returns nothing if the text is no layout.
std::optional<Layout> read_layout(std::string_view text);

// A number in a value.
struct Spot {
  Base base = Base::Bool;
  std::size_t offset = 0;
};
// Finds "[3].dTo[0]", "eState" or "" in a value. Nothing: there is no such part, or it is no single number.
std::optional<Spot> find_spot(const Layout& layout, std::string_view part);

// A number of any type but Text and Struct; `bytes` begins at its first byte.
double number_in(std::span<const std::uint8_t> bytes, Base base);
// A whole number that the type cannot have is the nearest one that it can.
void put_number(std::span<std::uint8_t> bytes, Base base, double number);

}  // namespace indurop::ros
