// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/near_name.h"

#include "core/base/nearest.h"

namespace indurop::robot {

std::string meant(std::string_view name, const std::vector<std::string>& known) {
  const std::string near = base::nearest(name, known);
  return near.empty() ? "" : "; did you mean '" + near + "'?";
}

std::string no_such(const char* what, const std::string& name, const std::vector<std::string>& known,
                    const char* keyword, const char* example) {
  const std::string near = meant(name, known);
  return std::string("there is no ") + what + " '" + name + "'" +
         (near.empty() ? std::string("; declare it, ") + keyword + " " + name + " = " + example : near);
}

}  // namespace indurop::robot
