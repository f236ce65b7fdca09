// SPDX-License-Identifier: Apache-2.0
// Variables and parts of them by the names people write, and values for them: the checks before a change.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/schema/schema.h"
#include "store/vars/store.h"

namespace indurop::operate {

// A variable or a part of it. Points into the store's schema: keep the store alive.
struct Item {
  std::string name;  // full name with the part, "knu::Robot::joints[1].y"
  schema::Place place;
  const vars::DirectoryEntry* entry = nullptr;
};

// Returns the full name of the part at `place`, which was found by `text`.
std::string full_name(const std::string& text, const schema::Place& place);

// Returns the item of a name, whose leading namespaces may be left out; or why there is none, with the nearest name.
Result<Item, base::Problem> find(const vars::Store& store, const std::string& name);
// Returns the items of exact names (parts too) and of globs, each once; or the errors of all that match nothing.
Result<std::vector<Item>, std::vector<std::string>> select(const vars::Store& store,
                                                           const std::vector<std::string>& names);
// Returns the whole variable; an error if it is not in the store.
Result<Item, base::Problem> whole(const vars::Store& store, const schema::Variable& variable);

// Reads one consistent version of the item's bytes, or returns the reason why not.
Result<std::vector<std::uint8_t>, base::Problem> read(const vars::Store& store, const Item& item);

// Reads values that schema::parse_value() cannot parse. Returns false, with `bytes` unchanged, if it cannot either.
using ReadLiteral = bool (*)(const schema::Type& type, std::string_view text, std::span<std::uint8_t> bytes);

struct Assignment {
  Item item;
  std::vector<std::uint8_t> bytes;  // of the item; parts that the text leaves out keep their value
  std::string text;                 // as written by the user
  ReadLiteral literal = nullptr;
};

// Parses a value for an item: checks type, array bounds and declared range.
Result<Assignment, base::Problem> parse(const vars::Store& store, Item item, std::string text,
                                        ReadLiteral literal = nullptr);
// The same for "NAME=VALUE".
Result<Assignment, base::Problem> parse(const vars::Store& store, const std::string& line,
                                        ReadLiteral literal = nullptr);
// Returns all assignments, or the errors of all invalid ones.
Result<std::vector<Assignment>, std::vector<std::string>> parse_all(const vars::Store& store,
                                                                    const std::vector<std::string>& lines,
                                                                    ReadLiteral literal = nullptr);

// Returns 1 for each byte of the item that the text gives, and 0 for those of parts that it leaves out.
std::vector<std::uint8_t> given_bytes(const Assignment& one);

// Returns whether the forced part is inside the item; whether the two overlap.
bool lies_in(const vars::Force& force, const Item& item) noexcept;
bool touches(const vars::Force& force, const Item& item) noexcept;
// Writes what the forces hold into bytes that were read of the item, where they overlap; returns whether one does. A
// force is in the table some milliseconds before the variable has its value: reports of both use this.
bool overlay(std::span<const vars::Force> forces, const Item& item, std::span<std::uint8_t> bytes) noexcept;

}  // namespace indurop::operate
