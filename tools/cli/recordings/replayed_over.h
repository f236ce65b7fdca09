// SPDX-License-Identifier: Apache-2.0
// Recorded values and those of a replay in the same plot.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <string>

#include "core/base/problem.h"
#include "tools/client/recordings/recording.h"

namespace indurop::tools {

// Returns the columns that differ between two CSV files of recorded_csv(), each with both signals. Columns of many
// values have two lines, "recorded" and "now"; those of few are two lanes, "now" below. None: nothing differs.
// `prefix`: in front of the recorded names. `left_out`: differing columns after the first 20, which do not fit in a
// picture. Errors: they are not such files.
Result<Recording, base::Problem> laid_over(const std::string& recorded, const std::string& prefix,
                                           const std::string& now, std::size_t& left_out);

}  // namespace indurop::tools
