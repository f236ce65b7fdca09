// SPDX-License-Identifier: Apache-2.0
// Variables and parts of them as a verb's arguments name them, their values, and what a declared range allows.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "operate/item.h"
#include "tools/command/verb.h"
#include "vars/store.h"

namespace indurop::tools {

using operate::Item;

// Items for names (exact parts) and globs, in the order given, no item twice. The exit code, after an error message for
// each name that is nothing, or of a board that is silent.
// Those of boards in the network have a value then, if it comes in time, or are named in a message.
enum class Values { Needed, NotNeeded };
int select_items(Context& context, const vars::Store& store, const std::vector<std::string>& names,
                 std::vector<Item>& items, Values values = Values::Needed);
using schema::is_glob;

// Value for JSON and CSV.
JsonValue raw_value(const schema::Type& type, std::span<const std::uint8_t> bytes);

// "0..10", "0.." without maximum, "" without range.
std::string range_text(const std::optional<schema::Range>& range);

// The options of a verb that prints a table of items it is given, here or of boards in the network; their names.
std::shared_ptr<const std::vector<std::string>> add_items_to_show(base::Options& app, Context& context);

}  // namespace indurop::tools
