// SPDX-License-Identifier: Apache-2.0
// The accesses of an I/O module (libiodispat.so): its variables are in its ioconfig.xml, not in its code.

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "config/check/check_parts.h"
#include "config/model/io_config.h"

namespace indurop::config {

struct IoAccess {
  std::vector<const schema::Variable*> reads;  // in the given schema
  std::vector<const schema::Variable*> writes;
};

bool is_io_module(const schema::ModuleFile& file) noexcept;
// Returns the module's ioconfig.xml; nothing if it names none.
std::optional<std::filesystem::path> io_config_of(const Module& module, const std::filesystem::path& folder);

// Returns the devices of that file; none if the module names no such file, or it cannot be read: other modules may have
// a property of this name with another file.
std::vector<IoDevice> io_devices_of(const Module& module, const std::filesystem::path& folder);

// Returns the module's ioconfig.xml and the files it names, without the board's own files (absolute names). Empty if it
// is not an I/O module.
std::vector<std::filesystem::path> io_files_of(const Module& module, const std::filesystem::path& folder);

// Returns the shared variables that the module's ioconfig.xml declares.
schema::Schema io_variables_of(const Module& module, const std::filesystem::path& folder);

// Reports errors of the file with their places in it.
IoAccess io_access_of(const Module& module, CheckContext& context);

}  // namespace indurop::config
