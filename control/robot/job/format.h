// SPDX-License-Identifier: Apache-2.0
// The layout of job files: blocks are indented by two spaces, words of the language are written as in the docs (MOVL,
// mm/s), no line ends with blanks, and at most one empty line separates others. Names, numbers, comments and the blanks
// between them are kept.

#pragma once

#include <string>

#include "control/robot/job/job.h"

namespace indurop::robot {

// Returns the text with this layout. Lines with errors are indented as well; their words are kept from the error on.
std::string format_job(const JobFile& file);

}  // namespace indurop::robot
