// SPDX-License-Identifier: Apache-2.0
// The sources that travel with a plant: which folder they are in, which of its files are sources, and their state in
// git.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/model/plant.h"
#include "core/base/json.h"
#include "core/base/problem.h"
#include "deploy/bundle/project.h"

namespace indurop::tools {

struct Project {
  std::filesystem::path folder;
  std::vector<deploy::ProjectFile> files;  // by path
  // {"indurop": version, "manifest": path of the manifest in the folder, "git": {"commit", "branch", "changed"} or
  // null, "left_out": [paths of files that hold private keys]}
  base::Json about;
  // What is in the folder and cannot travel.
  struct Skipped {
    enum Reason { Link, Repository };  // a symbolic link; a repository of its own, such as a submodule
    std::string path;
    Reason reason;
  };
  std::vector<Skipped> skipped;
};

// Returns nothing if the manifest says so (`<sources>off</sources>`), or names no folder and lies in one without
// CMakeLists.txt. In a git work tree the files are those that git tracks or would add, so .gitignore counts; elsewhere
// all files but hidden ones, programs, recordings (*.mcap), and folders named build*. Keys of the plant, files with a
// private key, and what indurop pack and package write never travel. Errors: the folder of <sources> is missing, or
// neither in the manifest's folder nor in one of `also`; git fails in a work tree; more than 64 MB.
Result<std::optional<Project>, base::Problem> find_project(const config::Plant& plant,
                                                           const std::vector<std::filesystem::path>& also = {});

}  // namespace indurop::tools
