// SPDX-License-Identifier: Apache-2.0
// Places in the text of a URDF file, which urdfdom does not tell.

#pragma once

#include <string>

#include "base/diagnostic.h"

namespace indurop::robot {

// Where a link or joint begins; 0 if nowhere.
std::size_t place_in_urdf(const std::string& text, const std::string& element, const std::string& name);
// An error there.
base::Diagnostic wrong_urdf(const std::string& file, const std::string& text, std::size_t offset,
                            const std::string& what);

}  // namespace indurop::robot
