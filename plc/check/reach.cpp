// SPDX-License-Identifier: Apache-2.0
#include "plc/check/reach.h"

namespace indurop::plc {
namespace {

void reach(const Pou& pou, std::set<const Pou*>& found) {
  if (found.insert(&pou).second) {
    for (const Pou* other : pou.uses) {
      reach(*other, found);
    }
  }
}

}  // namespace

std::set<const Pou*> reached_by(const TaskPlan& task) {
  std::set<const Pou*> found;
  for (const TaskProgram& one : task.programs) {
    reach(*one.pou, found);
  }
  return found;
}

}  // namespace indurop::plc
