// SPDX-License-Identifier: Apache-2.0
// Prints a PLCopen document: its networks as text or as an SVG picture.

#pragma once

#include <string>
#include <vector>

#include "control/plc/network/sheet.h"
#include "control/plc/plcopen/document.h"

namespace indurop::plc {

// The code of a POU, or of one of its actions and transitions.
struct PrintedBody {
  std::string heading;  // "main, program in LD", "main, action Blink in ST"
  std::string what;     // "POU main, action Blink"
  network::Body* body = nullptr;
};

// Returns all bodies of a document, or those of the named POU. Empty if there is none of this name.
[[nodiscard]] std::vector<PrintedBody> printed_bodies(plcopen::Document& document, const std::string& pou);

// Prints code as written, networks as drawings. Errors in the networks go to `diagnostics`; then nothing is drawn.
[[nodiscard]] std::string print_text(const std::vector<PrintedBody>& bodies, bool unicode, Diagnostics& diagnostics);
// Prints drawn languages only.
[[nodiscard]] std::string print_svg(const std::vector<PrintedBody>& bodies, Diagnostics& diagnostics);

// Returns title and comments above a network, one per line.
[[nodiscard]] std::vector<std::string> remarks_of(const network::Network& network);

}  // namespace indurop::plc
