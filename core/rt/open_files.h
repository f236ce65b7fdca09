// SPDX-License-Identifier: Apache-2.0
// What programs inherit that this process starts.

#pragma once

namespace indurop::rt {

// Closes all files that are open now, but standard input, output and error, in programs that are executed from now on.
// For libraries that open files without O_CLOEXEC. Thread-safe. Not real-time safe.
void close_open_files_on_exec() noexcept;

}  // namespace indurop::rt
