// SPDX-License-Identifier: Apache-2.0
// Whether two manifests of a plant say the same, apart from the files of modules.

#pragma once

#include <string>

#include "core/base/xml_element.h"

namespace indurop::config {

// Returns the first difference for people, "board a, module press: <period> was 1ms and is 2ms"; empty: there is none.
// Comments, spaces and the order of attributes do not count; names of files do, where they name a module.
std::string manifest_difference(const base::Element& before, const base::Element& after);

}  // namespace indurop::config
