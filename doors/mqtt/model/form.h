// SPDX-License-Identifier: Apache-2.0
// Types as `indurop serve` describes them: the schema `Type` of its OpenAPI description.

#pragma once

#include <optional>

#include "core/base/json.h"
#include "core/schema/schema.h"

namespace indurop::mqtt {

// Returns nothing if it is no such description. Offsets and sizes agree in what is returned.
std::optional<schema::Type> type_of(const base::Json& form);

}  // namespace indurop::mqtt
