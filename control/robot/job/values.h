// SPDX-License-Identifier: Apache-2.0
// Statements about values: shared variables that are set, at rest or during a motion, and variables of the job.

#pragma once

#include "control/robot/job/flow_statements.h"
#include "control/robot/job/place_formulas.h"
#include "control/robot/job/statement.h"

namespace indurop::robot {

class ValueReader {
 public:
  ValueReader(const StatementParts& parts, FlowReader& flow, PlaceFormulaReader& places)
      : line_(parts.line),
        draft_(parts.draft),
        names_(parts.names),
        expressions_(parts.expressions),
        flow_(flow),
        places_(places) {}

  void set();
  void pulse();
  void variable();
  void parameters();
  void assign();

 private:
  void add_setting(Step step);
  void set_on_path(Step wanted);
  void array(const JobToken& name);
  void compute_place();
  void add_assignment(int variable, Formula value);

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
  FlowReader& flow_;
  PlaceFormulaReader& places_;
};

}  // namespace indurop::robot
