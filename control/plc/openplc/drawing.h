// SPDX-License-Identifier: Apache-2.0
// Reads a drawing of the OpenPLC Editor: nodes and the lines between them, in JSON.

#pragma once

#include <string>

#include "control/plc/network/diagram.h"
#include "core/base/json.h"

namespace indurop::plc::openplc {

// Returns the text of a value; empty if it is another kind of value.
[[nodiscard]] std::string text_of(const base::Json& value);

// Reads {"name": ..., "rungs": [...]} of a ladder, {"name": ..., "rung": {...}} of a function block diagram.
[[nodiscard]] network::Body read_drawing(const base::Json& flow, network::Body::Language language, const Place& at,
                                         const std::string& pou);

}  // namespace indurop::plc::openplc
