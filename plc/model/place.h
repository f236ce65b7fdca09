// SPDX-License-Identifier: Apache-2.0
// Where something of a PLC program stands: line and column of a text, or an element of a network. Every node of the
// syntax tree carries one, so that errors and faults at run time can name it.

#pragma once

#include <memory>
#include <string>

#include "base/source_place.h"

namespace indurop::plc {

struct Place : base::SourcePlace {
  std::shared_ptr<const std::string> file;    // as the user wrote it
  std::shared_ptr<const std::string> within;  // of what is drawn: "POU main, rung 3, block TON0"; else null
};

// "prog.st:12:5"; parts that are not known are left out, "" if nothing is.
[[nodiscard]] std::string to_string(const Place& place);

}  // namespace indurop::plc
