// SPDX-License-Identifier: Apache-2.0
// The programs of a release of the platform that was deployed to a board: whether they are what was deployed, and how
// they are started.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "deploy/disk/deployment_files.h"

namespace indurop::deploy {

struct ReleasePrograms {
  std::string version;
  std::filesystem::path agent;      // indurop-agent of this machine's architecture
  std::filesystem::path libraries;  // folder of its libindurop.so
};

// Compares the files of this machine's architecture with their digests. A problem: the release is not on this board, a
// file is damaged, or it has no programs for this architecture.
Result<ReleasePrograms, base::Problem> sound_release(const DeploymentFiles& files, const std::string& id);

// Returns the folder of the deployed release that a program belongs to; empty: it is an installed program.
std::string release_folder_in(const std::filesystem::path& program);

// Returns this process's environment for programs of that release; empty `libraries`: for the installed programs. What
// an earlier release was started with is left out. `further`: "NAME=value".
std::vector<std::string> release_environment(const std::filesystem::path& platform,
                                             const std::filesystem::path& libraries,
                                             const std::vector<std::string>& further);

// Runs the agent and the node for their versions, which shows whether this machine can run them: libraries of the
// system, mount options. A problem says what happened. Waits for at most some seconds.
Result<void, base::Problem> try_release(const DeploymentFiles& files, const ReleasePrograms& release);

}  // namespace indurop::deploy
