// SPDX-License-Identifier: Apache-2.0
// The files of the versions of modules that a node has exchanged, in the folder of its state: the file of a version is
// often replaced by that of the next one, and a replay needs both. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "node/modules/module_library.h"

namespace indurop::node {

inline constexpr std::size_t kMostKeptVersions = 32;  // of all modules of a node

// Keeps the file of a version, and removes those that were kept longest ago. Errors: its content is not known any more,
// or those of the disk.
Result<void, base::Problem> keep_version(const std::string& node, const ModuleLibrary& version);

// The same for the program of a process module. Errors: those of the disk.
Result<void, base::Problem> keep_program(const std::string& node, const std::filesystem::path& program);

// Returns a file with this SHA-256: one of `likely`, one that the node has kept, one of the deployments of its agent,
// or a `.so` or `.exe` in `near`. Nothing: there is none here.
std::optional<std::filesystem::path> find_version_file(const std::string& node, const std::string& digest,
                                                       const std::vector<std::filesystem::path>& likely,
                                                       const std::filesystem::path& near);

}  // namespace indurop::node
