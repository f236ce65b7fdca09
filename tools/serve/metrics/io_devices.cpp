// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/metrics/io_devices.h"

#include <filesystem>
#include <utility>

#include "config/check/io_access.h"
#include "config/xml/plant_reader.h"
#include "tools/client/config/checked_config.h"

namespace indurop::serve {
namespace {

config::Config config_of(const std::string& board, const std::filesystem::path& file) {
  const config::CheckOptions options{.files = false, .adjust = true};
  if (!config::is_plant_file(file)) {
    return tools::load_config(file, options).config;
  }
  for (config::Board& one : tools::load_plant(file, options).plant.boards) {
    if (one.name == board) {
      return std::move(one.config);
    }
  }
  return {};
}

}  // namespace

std::vector<IoDeviceName> io_devices_of(const std::string& board, const tools::RunView& run) {
  const std::filesystem::path file = tools::fixed_text(run.block().config_file);
  std::vector<IoDeviceName> all;
  for (const config::Module& module : config_of(board, file).modules) {
    for (const config::IoDevice& device : config::io_devices_of(module, file.parent_path())) {
      if (!device.quality.empty()) {
        all.push_back({device.name, device.quality});
      }
    }
  }
  return all;
}

}  // namespace indurop::serve
