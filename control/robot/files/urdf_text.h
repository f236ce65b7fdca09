// SPDX-License-Identifier: Apache-2.0
// Places in the text of a URDF file, which urdfdom does not report.

#pragma once

#include <string>

#include "core/base/diagnostic.h"

namespace indurop::robot {

// Offset at which a link or joint begins; 0 if it is not found.
std::size_t place_in_urdf(const std::string& text, const std::string& element, const std::string& name);
// An error at that offset.
base::Diagnostic wrong_urdf(const std::string& file, const std::string& text, std::size_t offset,
                            const std::string& what);

}  // namespace indurop::robot
