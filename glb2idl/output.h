// SPDX-License-Identifier: Apache-2.0
// Writes generated texts to files: unchanged files stay untouched, changed ones are replaced in one step.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "glb2idl/emit.h"

namespace indurop::glb2idl {

// Creates missing folders. Returns which file could not be written and why; empty on success.
[[nodiscard]] std::string write_file(const std::string& path, std::string_view text);

// Writes all `outputs` below `folder`; stops at the first error.
[[nodiscard]] std::string write_all(const std::string& folder, const std::vector<Output>& outputs);

// Returns a Makefile rule: `target` depends on `files`.
[[nodiscard]] std::string depfile_text(const std::string& target, const std::vector<std::string>& files);

}  // namespace indurop::glb2idl
