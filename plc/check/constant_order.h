// SPDX-License-Identifier: Apache-2.0
// Constants may stand before those they are computed from.

#pragma once

#include <vector>

#include "plc/model/project.h"

namespace indurop::plc {

// Those that others need come first; everything else keeps its order. Circles stay as they are, and are errors later.
void order_constants(std::vector<ast::Variable>& variables);
void order_constants(Project& project);

}  // namespace indurop::plc
