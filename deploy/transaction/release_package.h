// SPDX-License-Identifier: Apache-2.0
// A release of the platform as a package: programs, libraries and pages of one installation for each architecture,
// below the architecture's name: amd64/bin/indurop-node.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "deploy/transaction/package.h"

namespace indurop::deploy {

// Returns the architecture of a program as Debian calls it: amd64, arm64; empty: no program of these.
std::string architecture_of(const std::filesystem::path& program);
// Returns the architecture of this process.
std::string own_architecture();

// Packs installations (prefixes with bin/, lib/ and share/indurop/; the folder of a build is one, too), each of another
// architecture. Links are followed. A problem names what an installation lacks. Not real-time safe.
Result<PackedPlant, base::Problem> pack_release(const std::vector<std::filesystem::path>& prefixes,
                                                const std::string& version, const std::string& comment);

// Returns the architectures for which the package has an agent.
std::vector<std::string> architectures_of(const Package& release);

}  // namespace indurop::deploy
