// SPDX-License-Identifier: Apache-2.0
// Variables and parts of them as arguments of a verb, their values, and their declared ranges.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "store/operate/item.h"
#include "store/vars/store.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

using operate::Item;

// Finds the items for names (exact parts) and globs, in the given order, no item twice. Returns the exit code, after an
// error message for each name without a match, or of a silent board. Items of boards in the network have a value
// afterwards, if it comes in time, or are named in a message.
enum class Values { Needed, NotNeeded };
int select_items(Context& context, const vars::Store& store, const std::vector<std::string>& names,
                 std::vector<Item>& items, Values values = Values::Needed);
using schema::is_glob;

// Returns the value for JSON and CSV.
JsonValue raw_value(const schema::Type& type, std::span<const std::uint8_t> bytes);

// Returns "0..10", "0.." without maximum, "" without range.
std::string range_text(const std::optional<schema::Range>& range);

// Adds the options of a verb that prints a table of given items, local or of boards in the network; returns their
// names.
std::shared_ptr<const std::vector<std::string>> add_items_to_show(base::Options& app, Context& context);

}  // namespace indurop::tools
