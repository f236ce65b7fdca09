// SPDX-License-Identifier: Apache-2.0
// A second source file that includes the generated header: the variables are the same, the table is made known once.

#include <indurop/generated.h>

namespace sample {
void set_number_elsewhere(std::int32_t value) {
  number = value;
}
}  // namespace sample
