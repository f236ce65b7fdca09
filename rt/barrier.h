// SPDX-License-Identifier: Apache-2.0
// A memory barrier on all processors at once, so that those who look often need none.

#pragma once

namespace indurop::rt {

// When it returns, whatever a processor stored before it could see what the caller had stored can be seen by all. Not
// real-time safe: may take some milliseconds.
void let_all_processors_see() noexcept;

}  // namespace indurop::rt
