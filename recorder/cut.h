// SPDX-License-Identifier: Apache-2.0
// A part of a recording as a recording of its own, which begins with what was known then.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>

#include "base/problem.h"

namespace indurop::recorder {

struct Cut {
  std::uint64_t runs = 0;
  std::uint64_t messages = 0;  // without those that say what was known before
  bool from_first_run = true;  // no run before it was left out
};

// Runs that ended between `from_ns` and `to_ns` after the recording's begin (0: its end), each with all its values.
// Errors: `file` cannot be read or is damaged; nothing lies between these times; `to` is there already or cannot be
// written. What was begun is removed then.
Result<Cut, base::Problem> cut(const std::filesystem::path& file, std::int64_t from_ns, std::int64_t to_ns,
                               const std::filesystem::path& to);

}  // namespace indurop::recorder
