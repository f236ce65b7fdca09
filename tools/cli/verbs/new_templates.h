// SPDX-License-Identifier: Apache-2.0
// The files of a new project, with the placeholders @NAME@, @NAMESPACE@, @PACKAGE@, @PROGRAMS@, @PLC@ and @VERSION@.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace indurop::tools {

struct ProjectFile {
  const char* path;  // relative to the project
  const char* text;
};

struct ProjectModule {
  const char* name;
  const char* xml;  // its <module> element
};

// The files of every project, without module.xml.
std::span<const ProjectFile> project_files();
// The PLC program of --with plc, and the build commands for it, for @PLC@.
ProjectFile plc_file();
std::string plc_build();

std::vector<ProjectModule> project_modules(bool with_plc);
std::string module_xml(const std::vector<ProjectModule>& modules);
// The modules distributed over this many boards, board1 and so on, one after another.
std::string plant_xml(const std::vector<ProjectModule>& modules, std::size_t boards);

}  // namespace indurop::tools
