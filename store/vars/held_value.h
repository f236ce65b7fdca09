// SPDX-License-Identifier: Apache-2.0
// Values of any type held by forces: a force holds one number, so a struct, an array or a text is held number by
// number. Not real-time safe.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/schema.h"
#include "store/vars/store.h"

namespace indurop::vars {

// The part of a value that one force can hold.
struct HeldPart {
  std::uint32_t offset = 0;  // in the value
  std::uint32_t size = 0;    // 1, 2, 4 or 8
};

// A part of a variable and what to hold of it, with its bytes.
struct HeldValue {
  const DirectoryEntry* variable = nullptr;
  std::uint32_t offset = 0;  // of the value in the variable
  schema::Type type;
  std::vector<std::uint8_t> bytes;  // type.size()
  std::vector<HeldPart> parts;
};

// Returns the parts that `text` names, if parse_value() can parse it, else all: `{x: 1}` holds x alone. A text is held
// in pieces of 8 characters up to its end.
std::vector<HeldPart> parts_to_hold(const schema::Type& type, std::string_view text,
                                    std::span<const std::uint8_t> bytes);

// Holds all of them until a time, or none. Errors: NoSpace (more than kMaxForces would be held), and those of
// Store::force().
Status hold(Store& store, std::span<const HeldValue> values, rt::MonoTime until);

// Sets later ends for those that still have the same value, and `was` as their end: no other user has re-forced or
// released them since. Returns NotFound if this is not true for at least one; the others are held until `until`.
Status prolong(Store& store, std::span<const HeldValue> values, rt::MonoTime was, rt::MonoTime until);
// Releases those for which the same is true.
Status release(Store& store, std::span<const HeldValue> values, rt::MonoTime was);

// A forced part, by the name people use: the words of a text are one part.
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
