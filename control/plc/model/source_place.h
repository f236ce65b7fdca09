// SPDX-License-Identifier: Apache-2.0
// A place in a PLC program: line and column of a text, or an element of a network. Every node of the syntax tree
// carries one, so that errors and faults at run time can name it.

#pragma once

#include <memory>
#include <string>

#include "core/base/source_place.h"

namespace indurop::plc {

struct Place : base::SourcePlace {
  std::shared_ptr<const std::string> file;    // as the user wrote it
  std::shared_ptr<const std::string> within;  // in drawings: "POU main, rung 3, block TON0"; else null
};

// Returns "prog.st:12:5"; unknown parts are left out, "" if nothing is known.
[[nodiscard]] std::string to_string(const Place& place);

}  // namespace indurop::plc
