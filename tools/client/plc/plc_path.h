// SPDX-License-Identifier: Apache-2.0
// The part of a variable that follows its name: fields and elements, as ".X", "[3]" or "[1,2].Y".

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "control/plc/check/type.h"

namespace indurop::tools {

struct Part {
  const plc::Type* type = nullptr;
  std::size_t offset = 0;  // in the packed value (control/plc/emit/watch_layout.h)
  std::string place = {};  // text after the name of a shared variable: "[2].y", counted from 0
};

// Returns nothing if there is no such part. `path` in capitals; "" is the whole variable.
[[nodiscard]] std::optional<Part> part_of(const plc::Type& type, std::string_view path);

}  // namespace indurop::tools
