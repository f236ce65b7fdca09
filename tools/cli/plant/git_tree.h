// SPDX-License-Identifier: Apache-2.0
// What git says about a folder: the files that it tracks or would add, and the commit.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "core/base/json.h"
#include "core/base/problem.h"

namespace indurop::tools {

struct GitTree {
  // Relative to the folder. A repository in the work tree is one path: a folder, with or without '/' at the end.
  std::set<std::string> paths;
  base::Json state;  // {"commit", "branch", "changed"}; null: nothing was committed yet
};

// Returns nothing for a folder outside of work trees. Errors: it is in one, and git is missing or refuses it; without
// git it is not known what is ignored. Changes nothing in the repository, and runs no program that it names as its
// monitor.
Result<std::optional<GitTree>, base::Problem> read_git_tree(const std::filesystem::path& folder);

}  // namespace indurop::tools
