// SPDX-License-Identifier: Apache-2.0
// Makes a node and its agent speak what an older release spoke: linked in place of core/schema/protocol.cpp.
#include "core/schema/topic_name.h"

namespace indurop::schema {

unsigned protocol() noexcept {
  return 1;
}

}  // namespace indurop::schema
