// SPDX-License-Identifier: Apache-2.0
// Standard input, output and error of a program.

#pragma once

namespace indurop::base {

// Opens /dev/null for those that are closed: else the next file that is opened takes their number, and what is printed
// is written into that file. To be called before any other file is opened.
void open_standard_files() noexcept;

}  // namespace indurop::base
