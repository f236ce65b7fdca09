// SPDX-License-Identifier: Apache-2.0
// Whether two manifests of a plant say the same, apart from the files of modules and, if wanted, their schedule.

#pragma once

#include <string>

#include "core/base/xml_element.h"

namespace indurop::config {

enum class ComparedElements {
  All,
  // Leaves out what another schedule may change: times, priorities and overrun policies of modules, their order in the
  // manifest, and modules that only one of the two has. Also pools that are sent between boards, which no node reads.
  NotSchedule,
};

// Returns the first difference for people, "board a, module press: <period> was 1ms and is 2ms"; empty: there is none.
// Comments, spaces and the order of attributes do not count; names of files do, where they name a module.
std::string manifest_difference(const base::Element& before, const base::Element& after,
                                ComparedElements compared = ComparedElements::All);

}  // namespace indurop::config
