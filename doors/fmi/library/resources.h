// SPDX-License-Identifier: Apache-2.0
// The folder resources/ of an FMU that a tool has unpacked.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "doors/fmi/contents/contents.h"

namespace indurop::fmi {

struct Resources {
  std::filesystem::path folder;
  Contents contents;
  [[nodiscard]] std::filesystem::path configuration() const {
    return folder / kConfigurationFolder / contents.configuration;
  }
};

// Returns the path of a file URI, "file:///tmp/a%20b/resources"; a text without a scheme is a path already. Empty: not
// a local file.
std::filesystem::path path_of_uri(const std::string& uri);

// Reads the resources in `named`; if they are not there, those next to this library, as the standard arranges the files
// of an FMU. Makes the programs of the configuration executable. Errors: not an FMU, damaged, programs that stay not
// executable.
Result<Resources, base::Problem> open_resources(const std::filesystem::path& named);

}  // namespace indurop::fmi
