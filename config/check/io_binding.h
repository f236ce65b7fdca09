// SPDX-License-Identifier: Apache-2.0
// Which variables the points of ioconfig.xml stand for.

#pragma once

#include <optional>
#include <vector>

#include "base/diagnostics.h"
#include "config/model/io_config.h"
#include "schema/schema.h"

namespace indurop::config {

// A point with the variables it stands for, parts of variables of the schema that was given.
struct BoundPoint {
  IoPoint point;
  schema::Place variable;
  std::optional<schema::Place> quality;
};
struct BoundDevice {
  IoDevice device;  // its points are in `points`, with those that in="" and out="" stand for
  std::vector<BoundPoint> points;
  std::optional<schema::Place> quality;
  std::optional<schema::Place> errors;
};
// Finds the variables and says what does not fit. `schema` must outlive what is returned.
std::vector<BoundDevice> bind_io(const IoConfig& config, const schema::Schema& schema,
                                 std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::config
