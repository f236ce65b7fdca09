// SPDX-License-Identifier: Apache-2.0
#include "tools/command/robot_files.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "robot/files.h"

namespace indurop::tools {
namespace {

const std::string* property(const config::Module& module, const char* name) {
  const auto found = std::find_if(module.properties.begin(), module.properties.end(),
                                  [name](const config::Property& one) { return one.name == name; });
  return found == module.properties.end() ? nullptr : &found->value;
}

// Modules that link libindurop-robot.a take what reads URDF from elsewhere.
bool reads_urdf(const schema::ModuleFile& file) {
  const std::string name = "_ZN4urdf9parseURDF";
  const auto found = std::lower_bound(file.imports.begin(), file.imports.end(), name);
  return file.imports.empty() || (found != file.imports.end() && found->rfind(name, 0) == 0);
}

double number(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  return *end == '\0' ? value : std::nan("");
}

std::string beside(const config::Config& config, const std::string& name) {
  return (config.file.parent_path() / name).lexically_normal().string();
}

}  // namespace

std::vector<base::Diagnostic> check_robot_files(const config::Config& config, const config::CheckResult& check) {
  std::vector<base::Diagnostic> all;
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    const std::string* urdf = property(config.modules[i], "urdf");
    const std::string* jobs = property(config.modules[i], "jobs");
    const bool built = i < check.facts.size();
    if ((urdf == nullptr && jobs == nullptr) || (built && !reads_urdf(check.facts[i].file))) {
      continue;
    }
    const std::string* workspace = property(config.modules[i], "workspace");
    robot::FileNames names{beside(config, urdf == nullptr ? "robot.urdf" : *urdf), {}, {}};
    std::istringstream words(jobs == nullptr ? "" : *jobs);
    for (std::string word; words >> word;) {
      names.jobs.push_back(beside(config, word));
    }
    std::istringstream corners(workspace == nullptr ? "" : *workspace);
    for (std::string word; corners >> word;) {
      names.workspace.push_back(number(word));
    }
    const std::vector<base::Diagnostic> found = robot::check_files(names);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

}  // namespace indurop::tools
