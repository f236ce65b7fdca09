// SPDX-License-Identifier: Apache-2.0
// Binds the points of ioconfig.xml to shared variables.

#pragma once

#include <optional>
#include <vector>

#include "config/model/io_config.h"
#include "core/base/diagnostics.h"
#include "core/schema/schema.h"

namespace indurop::config {

// A point with its variables, which are parts of variables of the given schema.
struct BoundPoint {
  IoPoint point;
  schema::Place variable;
  std::optional<schema::Place> quality;
};
struct BoundDevice {
  IoDevice device;  // its points are in `points`, including those that in="", out="", arrays of FMUs expand to
  std::vector<BoundPoint> points;
  std::optional<schema::Place> quality;
  std::optional<schema::Place> errors;
  std::optional<schema::Place> cut;
  std::optional<schema::Place> cable_errors;
};
// Finds the variables and reports errors. `schema` must outlive the returned devices.
std::vector<BoundDevice> bind_io(const IoConfig& config, const schema::Schema& schema,
                                 std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::config
