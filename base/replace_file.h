// SPDX-License-Identifier: Apache-2.0
// Writing a whole file: after a crash, a kill or a full disk there is the old content or the new one, never a half.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

#include <filesystem>
#include <string_view>

#include "base/file_problem.h"

namespace indurop::base {

// Whether the content is on the disk, folder included, when the call returns. Not for what can be made again.
enum class Durable : bool { No, Yes };

inline constexpr mode_t kUsualMode = 0666;  // less the umask of the process

// Puts `bytes` into the file `path`, new or not. They are written beside it and put in place in one step; nobody's file
// is used for that, and nothing is left behind on failure. A file that was there keeps its mode and, if allowed, its
// owner; a new one gets `mode` less the umask. A symbolic link is followed. What is no ordinary file (a pipe, a device,
// standard output by its name) is written to instead; a pipe that nobody reads is refused. Folders are not made.
// Errors: System, Directory. Only if the folder cannot be brought to the disk, the new content is in place in spite of
// an error.
Result<void, FileProblem> replace_file(const std::filesystem::path& path, std::string_view bytes, Durable durable,
                                       mode_t mode = kUsualMode);

// As replace_file, but `path` must not exist, not even as a link. Always durable.
// Errors: System; with EEXIST nothing was touched, else there is no file.
Result<void, FileProblem> create_file(const std::filesystem::path& path, std::string_view bytes, mode_t mode);

// Brings a file, or the names in a folder, to the disk. Errors: System.
Result<void, FileProblem> sync_to_disk(const std::filesystem::path& path);

}  // namespace indurop::base
