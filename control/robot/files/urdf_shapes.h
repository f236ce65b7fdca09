// SPDX-License-Identifier: Apache-2.0
// Reads the <collision> elements of the links of a URDF file.

#pragma once

#include <string>
#include <vector>

#include "control/robot/collision/bodies.h"
#include "control/robot/files/urdf_bodies.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

// The bodies of all links that the chain moves, or that are fixed to its base. A shape that cannot be checked is a
// warning, one that makes no sense an error; they refer to places in `text`.
std::vector<LinkBody> shapes_of(const urdf::ModelInterface& model, const std::vector<ChainLink>& chain,
                                const std::string& file, const std::string& text, std::vector<base::Diagnostic>& found);

}  // namespace indurop::robot
