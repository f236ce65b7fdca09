// SPDX-License-Identifier: Apache-2.0
// A memory barrier on all processors at once, so that frequent readers need none.

#pragma once

namespace indurop::rt {

// When it returns, everything that a processor stored before it could see the caller's stores is visible to all. Not
// real-time safe: may take some milliseconds.
void barrier_on_all_processors() noexcept;

}  // namespace indurop::rt
