// SPDX-License-Identifier: Apache-2.0
// What a plant runs, as its boards hold it: the list of files of the deployment, and its sources.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "deploy/bundle/project.h"
#include "deploy/transaction/package.h"
#include "tools/cli/plant/discovered_boards.h"
#include "tools/client/failure.h"

namespace indurop::tools {

struct RunningPlant {
  std::string plant;
  std::string id;
  deploy::Package package;
  deploy::BoardReport source;  // a board that has it
};

// Chooses the plant by its name (`plant`; empty: the only one), asks its boards for what they committed last. Errors:
// no such plant, several plants, boards that run different deployments, no answer.
Result<RunningPlant, Failure> running_plant(DiscoveredBoards& boards, std::uint64_t self, const std::string& plant);

// Fetches the sources of the deployment and unpacks them into `folder`, which must exist and be empty. Errors: the
// deployment has none; the board does not answer; what came is damaged.
Result<deploy::OpenedProject, Failure> fetch_project(DiscoveredBoards& boards, std::uint64_t self,
                                                     const RunningPlant& running, const std::filesystem::path& folder);

}  // namespace indurop::tools
