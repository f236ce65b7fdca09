// SPDX-License-Identifier: Apache-2.0
// Which release of the platform a board runs. Every start of a board's agent begins with the installed program, which
// reads that from the board's folder and becomes the agent of that release. A release in its trial gets a limited
// number of starts and a limited time, which the kernel ends whatever its agent does (ADR 38).

#pragma once

#include <filesystem>
#include <string>

#include "core/base/log.h"

namespace indurop::deploy {

// Variables of the environment between the installed program and the release that it becomes.
inline constexpr const char* kReleaseVariable = "INDUROP_RELEASE";
inline constexpr const char* kLauncherVariable = "INDUROP_LAUNCHER";

struct RunningRelease {
  std::string id;                  // kInstalledRelease, or that of the deployed release that this process is
  std::filesystem::path launcher;  // the installed program
  bool upgraded = false;           // the installed release was upgraded since, and is newer than the deployed one
  char** arguments = nullptr;      // of main()
};

// Becomes the agent of the release that the board is to run. Returns if that is this program, or if the release cannot
// be run, which the log says: a board is never without an agent.
RunningRelease become_release(const std::string& board, char** arguments, const base::Log& log);

// Becomes the installed program, which decides again. Returns only after a failure, with the reason.
std::string become_launcher(const RunningRelease& running, const std::filesystem::path& platform);

}  // namespace indurop::deploy
