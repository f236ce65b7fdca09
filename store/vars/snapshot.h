// SPDX-License-Identifier: Apache-2.0
// Reads parts of several variables that belong together, from a store that may be mapped read-only.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <span>

#include "store/vars/store.h"

namespace indurop::vars {

struct PartToRead {
  const DirectoryEntry* variable = nullptr;  // of the store's directory
  std::uint32_t offset = 0;
  std::span<std::uint8_t> to;
};

// Fills every part's `to` with what it was at one moment, between two commits; values of another board after one update
// of that board. Allocates; not real-time safe. Errors: OutOfRange (a part exceeds its variable), Dead (the store was
// truncated), TypeMismatch (the type of a variable has changed since it was found: attach again), Busy (the values were
// written without a pause, or are not sent together; `to` is unchanged then).
Status read_snapshot(const Store& store, std::span<const PartToRead> parts);

}  // namespace indurop::vars
