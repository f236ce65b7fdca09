// SPDX-License-Identifier: Apache-2.0
// Copies a file and tells why that failed; std::filesystem::copy_file() reports a full disk as "Input/output error".

#pragma once

#include <indurop/result.h>

#include <filesystem>

#include "core/base/problem.h"

namespace indurop::base {

// Makes a copy that shares its blocks with the original if the file system supports it. Replaces `to`, which is
// readable for its owner and group. A problem names the file and the cause.
Result<void, Problem> clone_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace indurop::base
