// SPDX-License-Identifier: Apache-2.0
// What was recorded and what a replay left, one over the other, for a chart.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <string>

#include "base/problem.h"
#include "tools/values/recording.h"

namespace indurop::tools {

// Of two CSV files as recorded_csv() makes them the columns that differ, each with both signals. Columns of many values
// have two lines, "recorded" and "now"; those of few are two lanes, "now" below. None: nothing differs. `prefix`:
// before the names that were recorded. `left_out`: differing columns behind the first 20, which a picture has no room
// for. Errors: they are no such files.
Result<Recording, base::Problem> laid_over(const std::string& recorded, const std::string& prefix,
                                           const std::string& now, std::size_t& left_out);

}  // namespace indurop::tools
