// SPDX-License-Identifier: Apache-2.0
// The configuration of one board: what <root> of a module.xml and <board> of a manifest hold.

#pragma once

#include "deploy/element.h"
#include "deploy/report.h"

namespace indurop::deploy {

// Reads the children of `container` into `config` (whose `file` is set) and names its modules. None may be there.
void read_configuration(const Element& container, Config& config, Report& report);
// Where relative file names of the XML file start.
std::filesystem::path folder_of(const std::filesystem::path& xml_file);

}  // namespace indurop::deploy
