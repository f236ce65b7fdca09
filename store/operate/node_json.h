// SPDX-License-Identifier: Apache-2.0
// JSON in files of a node's folder, for requests to it and its reports. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>

#include "core/base/json.h"

namespace indurop::operate {

// Replaces the file; the folder is made if needed. Errors: System (it cannot be written).
Status write_json(const std::string& node, const char* name, const base::Json& json);
// Returns nothing if there is no such file, or it is damaged.
std::optional<base::Json> read_json(const std::string& node, const char* name);
// As read_json(), and removes the file.
std::optional<base::Json> take_json(const std::string& node, const char* name);

}  // namespace indurop::operate
