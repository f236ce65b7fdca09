// SPDX-License-Identifier: Apache-2.0
// What an I/O module (libiodispat.so) reads and writes: its variables stand in its ioconfig.xml, not in its code.

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "config/check/check_parts.h"

namespace indurop::config {

struct IoAccess {
  std::vector<const schema::Variable*> reads;  // in the schema that was given
  std::vector<const schema::Variable*> writes;
};

bool is_io_module(const schema::ModuleFile& file) noexcept;
// The module's ioconfig.xml; empty if it names none.
std::optional<std::filesystem::path> io_config_of(const Module& module, const std::filesystem::path& folder);

// The module's ioconfig.xml and the files it names, those of them that are not the board's own (absolute names).
// Nothing if it is no I/O module.
std::vector<std::filesystem::path> io_files_of(const Module& module, const std::filesystem::path& folder);

// Reports what is wrong with the file, with its own places.
IoAccess io_access_of(const Module& module, CheckContext& context);

}  // namespace indurop::config
