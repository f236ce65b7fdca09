// SPDX-License-Identifier: Apache-2.0
// What <collision> says of the links of a URDF file.

#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "robot/bodies.h"
#include "robot/urdf_bodies.h"

namespace indurop::robot {

// The bodies of all links that the chain moves, or that stand on its base. What cannot be looked at is a warning, what
// makes no sense an error; their places are those in `text`.
std::vector<LinkBody> shapes_of(const urdf::ModelInterface& model, const std::vector<ChainLink>& chain,
                                const std::string& file, const std::string& text, std::vector<base::Diagnostic>& found);

}  // namespace indurop::robot
