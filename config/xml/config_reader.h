// SPDX-License-Identifier: Apache-2.0
// Reads the configuration of one board: the content of <root> in a module.xml and of <board> in a manifest.

#pragma once

#include "config/model/config.h"
#include "core/base/diagnostics.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// Reads the children of `container` into `config` (whose `file` is set) and names its modules. `config` must have no
// modules yet.
void read_configuration(const base::Element& container, config::Config& config, base::Diagnostics& report);
// Returns the folder at which relative file names of the XML file start.
std::filesystem::path folder_of(const std::filesystem::path& xml_file);

}  // namespace indurop::config
