// SPDX-License-Identifier: Apache-2.0
// Writes a whole file: after a crash, a kill or a full disk the file has the old content or the new one, never a part.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

#include <filesystem>
#include <string_view>

#include "core/base/file_problem.h"

namespace indurop::base {

// Yes: the content is on the disk, folder included, when the call returns. No: for files that can be made again.
enum class Durable : bool { No, Yes };

inline constexpr mode_t kUsualMode = 0666;  // minus the umask of the process

// Writes `bytes` into the file `path`, new or not. They are written to a temporary file that then replaces it in one
// step; no existing file is used for that, and nothing is left behind on failure. An existing file keeps its mode and,
// if allowed, its owner; a new one gets `mode` minus the umask. A symbolic link is followed. Anything but a regular
// file (a pipe, a device, standard output by its name) is written to directly; a pipe without a reader is refused.
// Folders are not created.
// Errors: System, Directory. Only if the folder cannot be synced to the disk, the new content is in place in spite of
// an error.
Result<void, FileProblem> replace_file(const std::filesystem::path& path, std::string_view bytes, Durable durable,
                                       mode_t mode = kUsualMode);

// Like replace_file, but `path` must not exist, not even as a link. Always durable. Errors: System; with EEXIST nothing
// was changed, else there is no file.
Result<void, FileProblem> create_file(const std::filesystem::path& path, std::string_view bytes, mode_t mode);

// Syncs a file, or the names in a folder, to the disk. Errors: System.
Result<void, FileProblem> sync_to_disk(const std::filesystem::path& path);

}  // namespace indurop::base
