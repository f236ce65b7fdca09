// SPDX-License-Identifier: Apache-2.0
// The block that an earlier run of a node left under its name, and what a new one takes from it.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <optional>
#include <string>

#include "store/vars/block.h"
#include "store/vars/shm_file.h"

namespace indurop::vars {

// Not real-time safe.
struct PreviousBlock {
  std::optional<ShmFile> file;      // empty: there is none
  std::optional<BlockIndex> index;  // empty: nothing in it can be trusted

  // Errors: those of ShmFile::open, but those that say that there is no block.
  static Result<PreviousBlock> find(const std::string& node);

  // For these the index must be there.
  // Makes attached processes look for the new block.
  void retire() const noexcept;
  // Copies the values of variables that have the same type in the plan's block, which is in `memory`.
  void carry_over(const BlockPlan& plan, std::byte* memory) const;
  // Variables that the earlier run mirrored from another board belong to this board until a mirror marks them again.
  void own_everything() const noexcept;
};

}  // namespace indurop::vars
