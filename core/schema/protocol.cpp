// SPDX-License-Identifier: Apache-2.0
// A separate file, so that tests can link programs of another release.
#include "core/schema/topic_name.h"

namespace indurop::schema {

unsigned protocol() noexcept {
  return 6;
}

}  // namespace indurop::schema
