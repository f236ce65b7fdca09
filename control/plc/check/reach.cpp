// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/reach.h"

namespace indurop::plc {
namespace {

void reach(const Pou& pou, std::set<const Pou*>& found) {
  std::vector<const Pou*> open{&pou};
  while (!open.empty()) {
    const Pou* one = open.back();
    open.pop_back();
    if (found.insert(one).second) {
      open.insert(open.end(), one->uses.begin(), one->uses.end());
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
