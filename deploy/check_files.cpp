// SPDX-License-Identifier: Apache-2.0
#include "deploy/check_parts.h"

namespace indurop::deploy {

void check_files(CheckContext& context) { context.result.facts.resize(context.config.modules.size()); }

}  // namespace indurop::deploy
