// SPDX-License-Identifier: Apache-2.0
// A PLCopen document on paper: its networks as text or as an SVG picture.

#pragma once

#include <string>
#include <vector>

#include "plc/network/sheet.h"
#include "plc/plcopen/document.h"

namespace indurop::plc {

// The code of a POU, or of one of its actions and transitions.
struct PrintedBody {
  std::string heading;  // "main, program in LD", "main, action Blink in ST"
  std::string what;     // "POU main, action Blink"
  network::Body* body = nullptr;
};

// All of a document, or of the POU named so. Empty if there is none of this name.
[[nodiscard]] std::vector<PrintedBody> printed_bodies(plcopen::Document& document, const std::string& pou);

// Code as it is written, networks drawn. What is wrong with the networks goes to `diagnostics`; then nothing is drawn.
[[nodiscard]] std::string print_text(const std::vector<PrintedBody>& bodies, bool unicode, Diagnostics& diagnostics);
// Drawn languages only.
[[nodiscard]] std::string print_svg(const std::vector<PrintedBody>& bodies, Diagnostics& diagnostics);

// Title and comments above a network, a line each.
[[nodiscard]] std::vector<std::string> remarks_of(const network::Network& network);

}  // namespace indurop::plc
