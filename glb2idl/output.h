// SPDX-License-Identifier: Apache-2.0
// Puts generated texts into files: unchanged files stay untouched, changed ones are replaced in one step.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "glb2idl/emit.h"

namespace indurop::glb2idl {

// Empty if done, else what could not be written and why. Creates missing folders.
[[nodiscard]] std::string write_file(const std::string& path, std::string_view text);

// All of `outputs` below `folder`; stops at the first error.
[[nodiscard]] std::string write_all(const std::string& folder, const std::vector<Output>& outputs);

// A Makefile rule: `target` depends on `files`.
[[nodiscard]] std::string depfile_text(const std::string& target, const std::vector<std::string>& files);

}  // namespace indurop::glb2idl
