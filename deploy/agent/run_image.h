// SPDX-License-Identifier: Apache-2.0
// The run block of a board's node (scheduler/run_block.h) for remote tools. deploy/words/node_texts.h has the form.

#pragma once

#include <string>

#include "core/base/json.h"

namespace indurop::deploy {

// Log entries that were being written during the copy are marked as such. Only reads; not real-time safe.
std::string run_image(const std::string& board);
// Return its "forces" and "lock".
base::Json forces_to_json(const std::string& board);
base::Json lock_to_json(const std::string& board);

}  // namespace indurop::deploy
