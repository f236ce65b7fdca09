// SPDX-License-Identifier: Apache-2.0
#include "tools/client/config/checked_config.h"

#include "config/xml/plant_reader.h"
#include "config/xml/reader.h"
#include "tools/client/robot/robot_files.h"

namespace indurop::tools {
namespace {

void append(const std::vector<base::Diagnostic>& from, std::vector<base::Diagnostic>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

bool CheckedConfig::ok() const {
  return !base::has_error(diagnostics);
}

bool CheckedPlant::ok() const {
  return !base::has_error(diagnostics);
}

CheckedConfig load_config(const std::string& file, const config::CheckOptions& options) {
  auto read = config::read_config(file);
  CheckedConfig out{std::move(read.config), {}, std::move(read.diagnostics)};
  if (out.ok()) {
    out.check = config::check_config(out.config, options);
    append(out.check.diagnostics, out.diagnostics);
    if (options.files) {
      append(check_robot_files(out.config, out.check), out.diagnostics);
    }
  }
  return out;
}

CheckedPlant load_plant(const std::string& file, config::CheckOptions options) {
  options.machine = false;
  auto read = config::read_plant(file);
  CheckedPlant out{std::move(read.plant), {}, std::move(read.diagnostics)};
  if (out.ok()) {
    out.check = config::check_plant(out.plant, options);
    append(out.check.diagnostics, out.diagnostics);
    for (std::size_t i = 0; options.files && i < out.check.boards.size(); ++i) {
      append(check_robot_files(out.plant.boards[i].config, out.check.boards[i]), out.diagnostics);
    }
  }
  return out;
}

}  // namespace indurop::tools
