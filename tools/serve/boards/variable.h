// SPDX-License-Identifier: Apache-2.0
// A variable as it is reported to clients: the format of its bytes, its quality, its forced parts.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "store/vars/store.h"
#include "tools/client/values/variables.h"

namespace indurop::serve {

enum class Quality : std::uint8_t { Good = 0, Stale = 1, Silent = 2, Unread = 3 };
const char* word_of(Quality quality) noexcept;

// The quality of a variable. Stale and Silent are for values that another board owns.
Quality quality_of(const vars::Store& store, const tools::Item& item) noexcept;
// Age in ns since the owning board confirmed the value; nothing for local variables and those never received.
std::optional<std::int64_t> age_of(const vars::Store& store, const tools::Item& item) noexcept;

// The type as JSON, schema `Type` of the OpenAPI description.
base::Json form_of(const schema::Type& type);
base::Json range_of(const std::optional<schema::Range>& range);

// Returns the items for a name, a part or a glob; adds errors to `problems`.
std::vector<tools::Item> items_named(const vars::Store& store, const std::string& node,
                                     const std::vector<std::string>& names, std::vector<std::string>& problems);

}  // namespace indurop::serve
