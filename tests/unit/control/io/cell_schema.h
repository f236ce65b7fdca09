// SPDX-License-Identifier: Apache-2.0
// The schema of cell.glb, as this test program carries it.

#pragma once

#include <gtest/gtest.h>

#include "core/schema/elf.h"
#include "core/schema/schema.h"

namespace indurop::io {

inline schema::Schema cell_schema() {
  const auto file = schema::read_module_file("/proc/self/exe");
  EXPECT_TRUE(file.ok());
  auto schema = schema::from_json(file.value().schema_json);
  EXPECT_TRUE(schema.ok());
  return std::move(schema).value();
}

}  // namespace indurop::io
