// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/robot_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "control/robot/files/list_bodies.h"
#include "tools/client/robot/pallets.h"
#include "tools/client/text/suggest.h"

namespace indurop::tools {
namespace {

const config::Property* property(const config::Module& module, std::string_view name) {
  const auto found = std::find_if(module.properties.begin(), module.properties.end(),
                                  [name](const config::Property& one) { return one.name == name; });
  return found == module.properties.end() ? nullptr : &*found;
}

// The text of a property of the module; empty: it is not set.
robot::PropertyText text_of(const config::Module& module) {
  return [&module](const char* name) {
    const config::Property* const found = property(module, name);
    return found == nullptr ? std::string() : found->value;
  };
}

// Modules that link libindurop-robot.a import the URDF parser from another library.
bool reads_urdf(const schema::ModuleFile& file) {
  const std::string name = "_ZN4urdf9parseURDF";
  const auto found = std::lower_bound(file.imports.begin(), file.imports.end(), name);
  return file.imports.empty() || (found != file.imports.end() && found->rfind(name, 0) == 0);
}

std::string in_folder_of(const config::Config& config, const std::string& name) {
  return (config.file.parent_path() / name).lexically_normal().string();
}

robot::FileNames files_of(const config::Config& config, const config::Module& module) {
  const config::Property* const urdf = property(module, "urdf");
  const config::Property* const jobs = property(module, "jobs");
  robot::FileNames names{in_folder_of(config, urdf == nullptr ? "robot.urdf" : urdf->value), {}, {}};
  std::istringstream words(jobs == nullptr ? "" : jobs->value);
  for (std::string word; words >> word;) {
    names.jobs.push_back(in_folder_of(config, word));
  }
  robot::Settings settings;
  static_cast<void>(robot::take_properties(text_of(module), settings));
  names.rotor_inertia = settings.rotor_inertia;
  names.tool_speed = settings.tool_speed;
  names.tool_turn_speed = settings.tool_turn_speed;
  return names;
}

// Warns of misspelled properties: a name that the robot task does not know is the module's own, unless it is similar to
// a known one.
void warn_of_names(const config::Config& config, const config::Module& module, std::vector<base::Diagnostic>& all) {
  std::vector<std::string> known = robot::setting_names();
  known.emplace_back(kPallets);
  for (const config::Property& one : module.properties) {
    const bool is_known = std::find(known.begin(), known.end(), one.name) != known.end();
    if (const std::string meant = is_known ? "" : did_you_mean(one.name, known); !meant.empty()) {
      all.push_back({base::Diagnostic::Severity::Warning, config.file.string(), one.place,
                     fmt::format("the robot has no property '{}'.{}", one.name, meant)});
    }
  }
}

bool is_number(const schema::Type& type) {
  using schema::Base;
  return type.dims.empty() && type.base != Base::Struct && type.base != Base::Text && type.base != Base::Char &&
         type.base != Base::Enum;
}

// Warns of a variable that jobs read or set and the access map does not know: <access> does not name it, and the code
// of the module does not use it. A module may read what it writes.
void warn_of_access(const robot::NamedVariable& named, const std::string& variable, const std::string& module,
                    const config::CheckResult& check, std::vector<base::Diagnostic>& all) {
  const auto use = std::find_if(check.uses.begin(), check.uses.end(),
                                [&variable](const config::VariableUse& one) { return one.name == variable; });
  const auto has_module = [&module](const std::vector<std::string>& modules) {
    return std::find(modules.begin(), modules.end(), module) != modules.end();
  };
  const bool known = use != check.uses.end() && (has_module(use->writers) || (!named.set && has_module(use->readers)));
  if (!known) {
    all.push_back(
        {base::Diagnostic::Severity::Warning, named.file, named.place,
         fmt::format("jobs {0} '{1}', which <access> of module '{2}' does not name; add <{3}>{1}</{3}>, so "
                     "that {4}",
                     named.set ? "set" : "read", variable, module, named.set ? "write" : "read",
                     named.set ? "other boards get it, and other writers are reported"
                               : "this board gets it from others, and modules on several cores are in order")});
  }
}

// Finds shared variables that jobs name and no module of the board declares, with which the node would not start, and
// those that the access map does not know. Each one is reported once for each use.
void check_variables(const robot::Findings& found, const std::string& module, const config::CheckResult& check,
                     std::vector<base::Diagnostic>& all) {
  std::set<std::string> wrong;
  std::set<std::pair<std::string, bool>> checked;
  for (const robot::NamedVariable& one : found.variables) {
    const auto place = schema::find_place(check.schema, one.name);
    if (place && is_number(place->type)) {
      // With errors, the access map may lack modules.
      if (check.ok() && checked.emplace(place->variable->name, one.set).second) {
        warn_of_access(one, place->variable->name, module, check, all);
      }
    } else if (wrong.insert(one.name).second) {
      all.push_back({base::Diagnostic::Severity::Error, one.file, one.place,
                     place ? fmt::format("'{}' is not a number or bool; name a part that is one", one.name)
                           : fmt::format("{} (jobs name variables of this board's modules)", place.error().message)});
    }
  }
}

// Finds robots that share the space of a module and do not report to this node, or that it does not name in <access>:
// on several cores, two robots could then take the same cells in the same period.
void check_others(const config::Config& config, const config::Module& module, const schema::Schema& schema,
                  std::vector<base::Diagnostic>& all) {
  const config::Property* const others = property(module, "other_robots");
  std::istringstream words(others == nullptr ? "" : others->value);
  for (std::string robot; words >> robot;) {
    for (const char* const variable : {"::ROBOT_SPACE", "::ROBOT_HELD"}) {
      const std::string name = robot + variable;
      const auto error = [&](const std::string& text) {
        all.push_back({base::Diagnostic::Severity::Error, config.file.string(), others->place,
                       fmt::format("property other_robots: {}", text)});
      };
      if (!schema::find_place(schema, name)) {
        error(
            fmt::format("no module of this node declares '{}'; write the namespaces of the other robots, separated by "
                        "spaces, and build each robot with its copy of robot_space.glb",
                        name));
        break;
      }
      if (std::find(module.reads.begin(), module.reads.end(), name) == module.reads.end()) {
        error(fmt::format("'{0}' is not in <access> of this module; add <read>{0}</read>", name));
      }
    }
  }
}

// Checks what only programs that show the robot read.
void check_pallets(const config::Config& config, const config::Module& module, const schema::Schema& schema,
                   std::vector<base::Diagnostic>& all) {
  const config::Property* const given = property(module, kPallets);
  if (given == nullptr) {
    return;
  }
  const auto error = [&](const std::string& text) {
    all.push_back({base::Diagnostic::Severity::Error, config.file.string(), given->place,
                   fmt::format("property {}: {}", kPallets, text)});
  };
  const auto pallets = pallets_in(given->value, robot::list_bodies(files_of(config, module)));
  if (!pallets) {
    error(pallets.error());
    return;
  }
  for (const Pallet& one : *pallets) {
    const auto place = schema::find_place(schema, one.used);
    if (!schema.variables.empty() && (!place || !is_number(place->type))) {
      error(place ? fmt::format("'{}' is not a number", one.used) : place.error().message);
    }
  }
}

}  // namespace

std::vector<base::Diagnostic> check_robot_files(const config::Config& config, const config::CheckResult& check) {
  std::vector<base::Diagnostic> all;
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    const config::Module& module = config.modules[i];
    const bool named = property(module, "urdf") != nullptr || property(module, "jobs") != nullptr;
    const bool built = i < check.facts.size();
    if (!named || (built && !reads_urdf(check.facts[i].file))) {
      continue;
    }
    const robot::Findings found = robot::check_module(files_of(config, module), text_of(module));
    for (const robot::WrongSetting& one : found.properties) {
      const config::Property* const wrong = property(module, one.property);
      all.push_back({base::Diagnostic::Severity::Error, config.file.string(),
                     wrong == nullptr ? module.place : wrong->place,
                     fmt::format("property {}: {}", one.property, one.text)});
    }
    warn_of_names(config, module, all);
    all.insert(all.end(), found.files.begin(), found.files.end());
    if (!base::has_error(found.files)) {
      check_pallets(config, module, check.schema, all);
    }
    if (!check.schema.variables.empty()) {
      check_others(config, module, check.schema, all);
    }
    if (!check.schema.variables.empty() && !base::has_error(found.files)) {
      check_variables(found, module.name, check, all);
    }
  }
  return all;
}

std::vector<RobotFiles> robot_files_of(const config::Config& config) {
  std::vector<RobotFiles> out;
  for (const config::Module& module : config.modules) {
    if (property(module, "urdf") != nullptr || property(module, "jobs") != nullptr) {
      robot::Settings settings;
      static_cast<void>(robot::take_properties(text_of(module), settings));
      settings.workspace.resize(settings.workspace.size() == 6 ? 6 : 0);
      out.push_back({module.name, files_of(config, module), settings.workspace, text_of(module)(kPallets)});
    }
  }
  const std::vector<RobotFiles> all = out;
  std::erase_if(out, [&all](const RobotFiles& one) {
    return one.names.jobs.empty() && std::any_of(all.begin(), all.end(), [&one](const RobotFiles& other) {
             return !other.names.jobs.empty() && other.names.urdf == one.names.urdf;
           });
  });
  return out;
}

}  // namespace indurop::tools
