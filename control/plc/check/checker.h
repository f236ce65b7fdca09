// SPDX-License-Identifier: Apache-2.0
// Checks a whole PLC project.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "control/plc/check/program.h"
#include "control/plc/model/diagnostics.h"

namespace indurop::plc {

struct CheckOptions {
  std::string space = "plc";              // namespace of the shared variables it declares
  bool library = false;                   // a PROGRAM is not required
  bool infinite_division = false;         // a REAL divided by zero is infinite or NaN; otherwise it is a fault
  std::vector<schema::Variable> foreign;  // shared variables of other .glb files
};

// Reports all errors to `diagnostics`; the result is complete if there are none.
[[nodiscard]] std::unique_ptr<Program> check(Project project, CheckOptions options, Diagnostics& diagnostics);

}  // namespace indurop::plc
