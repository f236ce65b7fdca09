// SPDX-License-Identifier: Apache-2.0
// Prints the syntax tree as Structured Text: the translation of networks, charts and instruction lists.

#pragma once

#include <string>

#include "control/plc/model/project.h"

namespace indurop::plc {

[[nodiscard]] std::string st_text(const ast::Pou& pou);

}  // namespace indurop::plc
