// SPDX-License-Identifier: Apache-2.0
// Variables and parts of them by the names people write, and values for them: what is checked before a change.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.h"
#include "schema/schema.h"
#include "vars/store.h"

namespace indurop::operate {

// A variable or a part of it. Points into the store's schema: keep the store.
struct Item {
  std::string name;  // full name with the part, "knu::Robot::joints[1].y"
  schema::Place place;
  const vars::DirectoryEntry* entry = nullptr;
};

// Item of a name, whose leading namespaces may be left out; or why there is none, with the nearest name.
Result<Item, base::Problem> find(const vars::Store& store, const std::string& name);
// Items of exact names (parts too) and of globs, none twice; or what is wrong with all that match nothing.
Result<std::vector<Item>, std::vector<std::string>> select(const vars::Store& store,
                                                           const std::vector<std::string>& names);
// The whole variable; nothing if it is not in the store.
Result<Item, base::Problem> whole(const vars::Store& store, const schema::Variable& variable);

// One consistent version of the item's bytes, or why there is none.
Result<std::vector<std::uint8_t>, base::Problem> read(const vars::Store& store, const Item& item);

// Reads values that schema::parse_value() does not understand. False, and `bytes` as they were: it does not either.
using ReadLiteral = bool (*)(const schema::Type& type, std::string_view text, std::span<std::uint8_t> bytes);

struct Assignment {
  Item item;
  std::vector<std::uint8_t> bytes;  // of the item; what the text leaves out is as it was
  std::string text;                 // as it was written
  ReadLiteral literal = nullptr;
};

// A value for an item: type, array bounds and declared range are checked.
Result<Assignment, base::Problem> parse(const vars::Store& store, Item item, std::string text,
                                        ReadLiteral literal = nullptr);
// The same of "NAME=VALUE".
Result<Assignment, base::Problem> parse(const vars::Store& store, const std::string& line);
// All good, or what is wrong with each that is not.
Result<std::vector<Assignment>, std::vector<std::string>> parse_all(const vars::Store& store,
                                                                    const std::vector<std::string>& lines);

// The bytes of `one` once it is written over `bytes`, the item's present ones.
void write_over(const Assignment& one, std::span<std::uint8_t> bytes);

// Whether the forced part lies within the item; whether the two overlap.
bool lies_in(const vars::Force& force, const Item& item) noexcept;
bool touches(const vars::Force& force, const Item& item) noexcept;

}  // namespace indurop::operate
