// SPDX-License-Identifier: Apache-2.0
#include "plc/check/context.h"

#include "base/nearest.h"

namespace indurop::plc {

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  const std::string found = base::nearest(name, known);
  return found.empty() ? "" : ", did you mean '" + found + "'?";
}

}  // namespace indurop::plc
