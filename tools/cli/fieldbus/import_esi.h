// SPDX-License-Identifier: Apache-2.0
// `indurop io import`: lists the devices of ESI files, and writes what an ioconfig.xml needs of them.

#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct ImportRequest {
  std::vector<std::string> files;
  std::filesystem::path to;
  std::vector<std::string> devices;
  std::string mode;
  std::chrono::nanoseconds cycle{1'000'000};
  std::string interface = "eth1";
  std::string space;  // empty: IO, or the name of the FMU
  std::filesystem::path glb;
};

// The request lives as long as the options.
void add_import_options(base::Options& verb, ImportRequest& request);
int import_esi(Context& context, const ImportRequest& request);

}  // namespace indurop::tools
