// SPDX-License-Identifier: Apache-2.0
// The files of a new project. @NAME@, @PACKAGE@, @PROGRAMS@ and @VERSION@ stand for what is filled in.

#pragma once

#include <span>

namespace indurop::tools {

struct ProjectFile {
  const char* path;  // inside the project
  const char* text;
};

std::span<const ProjectFile> project_files();

}  // namespace indurop::tools
