// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/mirror_text.h"

#include "core/base/json.h"
#include "core/rt/clock.h"
#include "network/mirror/frames/mirrored_variables.h"
#include "store/vars/node_lock.h"
#include "store/vars/shm_file.h"

namespace indurop::deploy {

std::string mirror_text(const std::string& board) {
  using base::Json;
  Json variables = Json::array();
  const auto file = vars::ShmCopy::of(vars::mirror_file(board));
  const mirror::MirrorBlock* block =
      file ? mirror::mirror_block_in({file.value().data(), file.value().size()}) : nullptr;
  if (block != nullptr && vars::running_node(board) > 0) {
    for (const mirror::MirroredVariable& variable : mirror::mirrored_variables(board, *block, rt::MonoClock::now())) {
      variables.push_back({{"name", variable.name},
                           {"owner", variable.owner},
                           {"age_ns", variable.age_ns < 0 ? Json() : Json(variable.age_ns)},
                           {"valid", variable.valid}});
    }
  }
  return Json{{"variables", variables}}.dump();
}

}  // namespace indurop::deploy
