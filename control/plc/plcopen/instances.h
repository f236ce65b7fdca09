// SPDX-License-Identifier: Apache-2.0
// Reads <instances> of a PLCopen file: configurations, resources, tasks, programs.

#pragma once

#include <optional>
#include <string_view>

#include "control/plc/model/project.h"
#include "control/plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

void read_instances(const Node& instances, Project& into, Diagnostics& diagnostics);

// Reads a <resource> outside of a configuration as a configuration of its name.
void read_application(const Node& resource, Project& into, Diagnostics& diagnostics);

// Returns nanoseconds for "T#10ms", "TIME#1s", ISO 8601 as in "PT0.01S", "P1DT2H", or "00:00:00.010000"; empty if it is
// none of these.
[[nodiscard]] std::optional<std::int64_t> interval_ns(std::string_view text);

}  // namespace indurop::plc::plcopen
