// SPDX-License-Identifier: Apache-2.0
#include "tools/verbs.h"

#include <array>

namespace indurop::tools {

std::span<const Verb> all_verbs() {
  // In the order `indurop help` shows them.
  static const std::array kVerbs{kCheckVerb, kPlanVerb, kStatusVerb, kVarsVerb, kGetVerb, kSetVerb};
  return kVerbs;
}

}  // namespace indurop::tools
