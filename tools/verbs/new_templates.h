// SPDX-License-Identifier: Apache-2.0
// The files of a new project. @NAME@, @NAMESPACE@, @PACKAGE@, @PROGRAMS@, @PLC@ and @VERSION@ stand for what is filled
// in.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace indurop::tools {

struct ProjectFile {
  const char* path;  // inside the project
  const char* text;
};

struct ProjectModule {
  const char* name;
  const char* xml;  // its <module>
};

// Those of every project, but for module.xml.
std::span<const ProjectFile> project_files();
// The PLC program of --with plc, and what builds it, for @PLC@.
ProjectFile plc_file();
std::string plc_build();

std::vector<ProjectModule> project_modules(bool with_plc);
std::string module_xml(const std::vector<ProjectModule>& modules);
// The modules dealt out to this many boards, board1 and so on, in turn.
std::string plant_xml(const std::vector<ProjectModule>& modules, std::size_t boards);

}  // namespace indurop::tools
