// SPDX-License-Identifier: Apache-2.0
// DDS Security for a participant: its configuration, the plugins it needs, and what can be known to be wrong before.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "base/problem.h"
#include "dds/network_settings.h"

namespace indurop::dds {

// Folder of Cyclone's three plugins: beside the library, wherever that was loaded from. Empty: they are not there.
std::filesystem::path security_plugins();
// <Security> for the domain's configuration; empty for an open plant.
std::string security_configuration(const Security& security, const std::filesystem::path& plugins);

// Errors: the plugins are not there, or a file cannot be read; with what to do about it.
Result<void, base::Problem> security_usable(const Security& security, const std::filesystem::path& plugins);

}  // namespace indurop::dds
