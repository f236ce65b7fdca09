// SPDX-License-Identifier: Apache-2.0
// Facts about the file that a table of variables came from, for messages: read only when something does not match.

#pragma once

#include <string>

#include "core/schema/elf.h"
#include "core/schema/schema.h"

namespace indurop::runtime {

struct ModuleFacts {
  std::string path;  // "" if unknown
  bool readable = false;
  schema::ModuleFile file;
  schema::Schema schema;

  [[nodiscard]] const schema::Variable* variable(std::uint64_t name_hash) const noexcept;
  // Returns whether the code of the file reads or writes the variable; true if that is unknown.
  [[nodiscard]] bool uses(std::uint64_t name_hash) const noexcept;
};

// `address`: any address inside the loaded file. Not real-time safe.
ModuleFacts read_module_of(const void* address);
// Identifies the loaded file that holds `address`; nullptr: there is none. Takes no lock, nor does path_of().
const void* image_of(const void* address) noexcept;
// Path of the loaded file that holds `address`, "" if unknown.
std::string path_of(const void* address);

}  // namespace indurop::runtime
