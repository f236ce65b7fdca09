// SPDX-License-Identifier: Apache-2.0
// The parts of the parser that the readers of all statements share.

#pragma once

#include "control/robot/job/draft.h"
#include "control/robot/job/expression.h"
#include "control/robot/job/line.h"
#include "control/robot/job/names.h"

namespace indurop::robot {

struct StatementParts {
  JobLine& line;
  JobDraft& draft;
  JobNames& names;
  ExpressionReader& expressions;
};

}  // namespace indurop::robot
