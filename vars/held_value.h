// SPDX-License-Identifier: Apache-2.0
// Values of any type held by forces: a force is of one number, so a struct, an array or a text is held number by
// number. Not real-time safe.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schema/schema.h"
#include "vars/store.h"

namespace indurop::vars {

// What one force can hold of a value.
struct HeldPart {
  std::uint32_t offset = 0;  // in the value
  std::uint32_t size = 0;    // 1, 2, 4 or 8
};

// A part of a variable and what of it is to be held, at which bytes.
struct HeldValue {
  const DirectoryEntry* variable = nullptr;
  std::uint32_t offset = 0;  // of the value in the variable
  schema::Type type;
  std::vector<std::uint8_t> bytes;  // type.size()
  std::vector<HeldPart> parts;
};

// The parts that `text` speaks of, if parse_value() understands it, else all: `{x: 1}` holds x alone. A text is held by
// 8 characters up to its end.
std::vector<HeldPart> parts_to_hold(const schema::Type& type, std::string_view text,
                                    std::span<const std::uint8_t> bytes);

// Holds all of them until a time, or none. Errors: NoSpace (more than kMostForces would be held), and those of
// Store::force().
Status hold(Store& store, std::span<const HeldValue> values, rt::MonoTime until);

// Later ends for those that still have the same value, and `was` as their end: that nobody else has forced or let go
// since. NotFound: one at least was not; the others are held until `until`.
Status prolong(Store& store, std::span<const HeldValue> values, rt::MonoTime was, rt::MonoTime until);
// Lets those go of which the same is true.
Status let_go(Store& store, std::span<const HeldValue> values, rt::MonoTime was);

// What is forced, by the names people use: the words of a text are one.
struct ForcedPart {
  std::string name;  // "PLC_ROBOT::O[3]"
  schema::Type type;
  std::vector<std::uint8_t> bytes;  // type.size()
  rt::MonoTime until;               // or kForever
  const DirectoryEntry* variable = nullptr;
  std::uint32_t offset = 0;  // of the part, or of a word of the text
};
std::vector<ForcedPart> forced_parts(const Store& store);

}  // namespace indurop::vars
