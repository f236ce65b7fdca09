// SPDX-License-Identifier: Apache-2.0
#include "deploy/check_parts.h"

namespace indurop::deploy {

void check_access(CheckContext& context) { context.result.uses.clear(); }

}  // namespace indurop::deploy
