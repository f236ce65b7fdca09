// SPDX-License-Identifier: Apache-2.0
// The configuration of one board: what <root> of a module.xml and <board> of a manifest hold.

#pragma once

#include "base/diagnostics.h"
#include "base/xml_element.h"
#include "config/model/config.h"

namespace indurop::config {

// Reads the children of `container` into `config` (whose `file` is set) and names its modules. None may be there.
void read_configuration(const base::Element& container, config::Config& config, base::Diagnostics& report);
// Where relative file names of the XML file start.
std::filesystem::path folder_of(const std::filesystem::path& xml_file);

}  // namespace indurop::config
