// SPDX-License-Identifier: Apache-2.0
// Reads devices of ioconfig.xml that are files: recorded values and FMUs.

#pragma once

#include <filesystem>

#include "config/model/io_config.h"
#include "config/xml/attributes.h"

namespace indurop::config {

// `folder`: that of the ioconfig.xml.
void read_io_csv(Attributes& attributes, const std::filesystem::path& folder, IoCsv& csv);
void read_io_fmu(Attributes& attributes, const std::filesystem::path& folder, IoFmu& fmu);
// <set at="mass" value="120"/>
void read_io_start(const base::Element& element, IoFmu& fmu, base::Diagnostics& report);

}  // namespace indurop::config
