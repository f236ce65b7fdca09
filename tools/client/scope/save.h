// SPDX-License-Identifier: Apache-2.0
// Saves the result of a scope: chart, CSV as with `indurop watch -o csv`, JSON, MCAP.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/json.h"
#include "core/base/problem.h"
#include "tools/client/recordings/recording.h"
#include "tools/client/scope/scope.h"

namespace indurop::tools {

// For charts; the trigger is at 0 s.
Recording recording_of(const Capture& capture);
std::string csv_of(const Capture& capture);
// Unknown values are null.
base::Json json_of(const Capture& capture);
// Writes one message per tick and line. Errors: the file exists already, or cannot be written.
Result<void, base::Problem> save_mcap(const std::filesystem::path& path, const Capture& capture,
                                      const std::string& node);
// "'speed > 100' at tick 1200, 100 ticks before and 400 after, every 1 ms"
std::string heading_of(const Capture& capture);

}  // namespace indurop::tools
