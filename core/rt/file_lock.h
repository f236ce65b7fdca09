// SPDX-License-Identifier: Apache-2.0
// The lock of an open file: held until the last copy of its descriptor is closed, however the process ends.

#pragma once

#include <indurop/result.h>

namespace indurop::rt {

enum class FileLock { Shared, Exclusive };  // Shared: the file is open for reading; Exclusive: for writing

// Errors: Busy (another process holds it), System. lock_file_when_free() waits until it is free. Not real-time safe.
Status lock_file(int file, FileLock kind) noexcept;
Status lock_file_when_free(int file, FileLock kind) noexcept;
// Returns true if a process holds it for writing; `file` is open for reading. Not real-time safe.
bool is_locked(int file) noexcept;

}  // namespace indurop::rt
