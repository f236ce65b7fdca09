// SPDX-License-Identifier: Apache-2.0
// The sources of a plant as one file, which travels with a deployment: project.json about it, then the files with their
// paths. Equal projects give equal files.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/base/problem.h"

namespace indurop::deploy {

// Path of the archive among the files of a package.
inline constexpr const char* kProjectPath = ".indurop/project.tar.zst";

// Size of all sources of a plant, at most.
inline constexpr std::uint64_t kMaxProjectBytes = std::uint64_t{64} << 20U;

// A file of a project: its path in the project and where it is now.
struct ProjectFile {
  std::string path;
  std::filesystem::path source;
};

// `about`: see tools/cli/plant/project_files.h. Errors: a file cannot be read, the archive cannot be written.
Result<void, base::Problem> write_project(const base::Json& about, const std::vector<ProjectFile>& files,
                                          const std::filesystem::path& archive);

struct OpenedProject {
  base::Json about;
  std::vector<std::string> paths;  // of the files that were unpacked
};
// Unpacks a project into `folder`, which must exist and be empty. Nothing outside of it is written, regardless of who
// made the archive, and after an error nothing is left in it. Errors: damaged, paths that lead outside or into a
// repository of git, larger than kMaxProjectBytes, files that cannot be written.
Result<OpenedProject, base::Problem> open_project(const std::filesystem::path& archive,
                                                  const std::filesystem::path& folder);

}  // namespace indurop::deploy
