// SPDX-License-Identifier: Apache-2.0
// The names of types in the JSON of a schema: json_write.cpp writes them, json_read.cpp reads them.

#pragma once

#include <array>

#include "core/schema/schema.h"

namespace indurop::schema {

inline constexpr std::array<const char*, 15> kBaseNames{"bool",   "char",   "int8",   "uint8", "int16",
                                                        "uint16", "int32",  "uint32", "int64", "uint64",
                                                        "float",  "double", "text",   "enum",  "struct"};
static_assert(kBaseNames.size() == static_cast<std::size_t>(Base::Struct) + 1);

}  // namespace indurop::schema
