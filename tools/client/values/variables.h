// SPDX-License-Identifier: Apache-2.0
// Variables and parts of them as arguments, their values, and their declared ranges.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "store/operate/item.h"
#include "store/vars/store.h"
#include "tools/client/text/table.h"
#include "tools/client/values/access.h"

namespace indurop::tools {

using operate::Item;

// Finds the items for names (exact parts) and globs, in the given order, no item twice. Returns the exit code, after an
// error message for each name without a match, or of a silent board. Items of boards in the network have a value
// afterwards, if it comes in time, or are named in a message.
enum class Values { Needed, NotNeeded };
int select_items(Access& access, const vars::Store& store, const std::vector<std::string>& names,
                 std::vector<Item>& items, Values values = Values::Needed);
using schema::is_glob;

// Returns the value for JSON and CSV.
JsonValue raw_value(const schema::Type& type, std::span<const std::uint8_t> bytes);

// Returns "0..10", "0.." without maximum, "" without range.
std::string range_text(const std::optional<schema::Range>& range);

}  // namespace indurop::tools
