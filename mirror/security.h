// SPDX-License-Identifier: Apache-2.0
// DDS Security for a participant: its configuration, the plugins it needs, and what can be known to be wrong before.

#pragma once

#include <filesystem>
#include <string>

#include "mirror/settings.h"

namespace indurop::mirror {

// Text that stands for itself in XML.
std::string xml_text(const std::string& text);

// Folder of Cyclone's three plugins: beside the library, wherever that was loaded from. Empty: they are not there.
std::filesystem::path security_plugins();
// <Security> for the domain's configuration; empty for an open plant.
std::string security_configuration(const Security& security, const std::filesystem::path& plugins);

// Are the plugins there, and the files readable. Otherwise `problem` says what to do.
bool security_usable(const Security& security, const std::filesystem::path& plugins, std::string& problem);

}  // namespace indurop::mirror
