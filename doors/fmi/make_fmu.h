// SPDX-License-Identifier: Apache-2.0
// Writes an FMU: a ZIP archive with the model description, the library, and the configuration with its files.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "doors/fmi/configuration.h"

namespace indurop::fmi {

enum class Version { Fmi2, Fmi3 };

struct FmuRequest {
  Version version = Version::Fmi2;
  std::filesystem::path output;
  std::vector<std::filesystem::path> also;  // folders from which files may be taken: deploy::pack_plant()
  std::string tool;                         // "InduRoP 0.2.0"
};

// Returns the name of the library and of the C interface's prefix that an FMU has: letters, digits and '_'.
std::string identifier_of(const std::filesystem::path& output);

// The same request gives the same bytes. `output` is complete or as it was before. Errors: files that cannot be read,
// that must not be taken along, or written; the library is not installed.
Result<void, base::Problem> make_fmu(const Configuration& configuration, const Choice& choice,
                                     const FmuRequest& request);

}  // namespace indurop::fmi
