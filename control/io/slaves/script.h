// SPDX-License-Identifier: Apache-2.0
// Reads a list of faults, one a line: when, what, to which slave, for how long.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "control/io/ethercat/simulator/bus.h"
#include "core/base/diagnostic.h"

namespace indurop::io::slaves {

// The forms of a line, for help.
std::string script_help();

struct Script {
  std::vector<ethercat::Fault> faults;
  std::vector<base::Diagnostic> diagnostics;
};
// `slaves`: how many there are.
Script read_script(const std::string& text, const std::filesystem::path& file, std::size_t slaves);

}  // namespace indurop::io::slaves
