// SPDX-License-Identifier: Apache-2.0
#include "plc/check/context.h"

#include <algorithm>

#include "glb2idl/text.h"

namespace indurop::plc {

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  const std::string wanted = upper(name).substr(0, 100);
  std::size_t best = std::min<std::size_t>(wanted.size() / 2 + 1, 3);
  std::string_view found;
  for (const std::string& one : known) {
    const std::size_t here = glb2idl::edits(wanted, upper(one).substr(0, 100));
    if (here < best) {
      best = here;
      found = one;
    }
  }
  return found.empty() ? "" : ", did you mean '" + std::string(found) + "'?";
}

}  // namespace indurop::plc
