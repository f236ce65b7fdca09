// SPDX-License-Identifier: Apache-2.0
// What the points of an EtherCAT device need of its slave, and whether the slave can exchange it, as far as the maker's
// description (ESI) says.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <span>
#include <vector>

#include "config/check/io_binding.h"
#include "control/io/esi/esi_file.h"
#include "control/io/ethercat/master/mapping.h"

namespace indurop::config {

// The objects of points, as a master maps them.
std::vector<io::ethercat::WantedObject> wanted_objects(std::span<const IoPoint> points);

// The device of the description, by the identity in the file. Errors: those of the description, or that it has no such
// device; `file` is the ioconfig.xml. Not real-time safe.
Result<io::esi::Device, std::vector<base::Diagnostic>> described_slave(const IoDevice& device,
                                                                       const std::filesystem::path& file);

// Adds an error for each point that the described slave cannot exchange.
void check_mapping(const BoundDevice& device, const std::filesystem::path& file,
                   std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::config
