// SPDX-License-Identifier: Apache-2.0
#include "deploy/plan_parts.h"

namespace indurop::deploy {

std::string plan_svg(const Config& config, const CheckResult& check) { return config.modules.empty() || check.periodic.empty() ? "" : ""; }

}  // namespace indurop::deploy
