// SPDX-License-Identifier: Apache-2.0
// POSIX has no drivers that could be asked.

#include "core/rt/network_card.h"

namespace indurop::rt {

CardSettings card_settings(const std::string& /*interface*/) {
  return {};
}

}  // namespace indurop::rt
