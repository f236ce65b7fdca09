// SPDX-License-Identifier: Apache-2.0
// A file of its own, so that tests can link programs of another release.
#include "schema/topic_name.h"

namespace indurop::schema {

unsigned protocol() noexcept {
  return 5;
}

}  // namespace indurop::schema
