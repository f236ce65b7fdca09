// SPDX-License-Identifier: Apache-2.0
// What a module file says about what the module keeps between runs, apart from its declaration, which is code.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

namespace indurop::schema {

struct KeptNotes {
  bool stripped = false;     // the symbols of variables that no other file uses were removed
  std::string undeclarable;  // what a PLC program keeps and its declaration cannot contain, as text for people
};

// Errors: those of read_module_file().
Result<KeptNotes> read_kept_notes(const std::filesystem::path& file);

}  // namespace indurop::schema
