// SPDX-License-Identifier: Apache-2.0
// A variable as clients are told of it: the form of its bytes, its quality, what of it is forced.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "tools/values/variables.h"
#include "vars/store.h"

namespace indurop::serve {

enum class Quality : std::uint8_t { Good = 0, Stale = 1, Silent = 2, Unread = 3 };
const char* word_of(Quality quality) noexcept;

// Stale and Silent are for values that another board owns.
Quality quality_of(const vars::Store& store, const tools::Item& item) noexcept;
// Since the board that owns it confirmed the value; nothing for own ones and those never heard.
std::optional<std::int64_t> age_of(const vars::Store& store, const tools::Item& item) noexcept;

// Schema `Type` of the description.
base::Json form_of(const schema::Type& type);
base::Json range_of(const std::optional<schema::Range>& range);

// Items for a name, a part or a glob; what is wrong goes to `problems`.
std::vector<tools::Item> items_named(const vars::Store& store, const std::string& node,
                                     const std::vector<std::string>& names, std::vector<std::string>& problems);

}  // namespace indurop::serve
