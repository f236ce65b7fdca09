// SPDX-License-Identifier: Apache-2.0
// Extracts a part of a recording as a recording of its own, which begins with the values known at that time.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>

#include "core/base/problem.h"

namespace indurop::recorder {

// Metadata of a part. kCutEnd: up to this log time everything was copied, and later runs were left out.
inline constexpr const char* kCutMetadata = "indurop.cut";
inline constexpr const char* kCutEnd = "end_ns";

struct Cut {
  std::uint64_t runs = 0;
  std::uint64_t messages = 0;  // without the messages with values known before
  bool from_first_run = true;  // no run before it was left out
};

// Copies the runs that ended between `from_ns` and `to_ns` after the recording's begin (0: its end), each with all its
// values. Errors: `file` cannot be read or is damaged; it has nothing between these times; `to` exists already or
// cannot be written. A partial `to` is removed then.
Result<Cut, base::Problem> cut(const std::filesystem::path& file, std::int64_t from_ns, std::int64_t to_ns,
                               const std::filesystem::path& to);

}  // namespace indurop::recorder
