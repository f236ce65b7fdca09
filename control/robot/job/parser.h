// SPDX-License-Identifier: Apache-2.0
// The parser of job files: calls the reader of each statement, and resolves names when all files have been read.

#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "control/robot/job/blocks.h"
#include "control/robot/job/bodies.h"
#include "control/robot/job/each_period.h"
#include "control/robot/job/flow_statements.h"
#include "control/robot/job/motions.h"
#include "control/robot/job/place_formulas.h"
#include "control/robot/job/places.h"
#include "control/robot/job/push_reader.h"
#include "control/robot/job/statement.h"
#include "control/robot/job/tools.h"
#include "control/robot/job/values.h"
#include "control/robot/job/weaving.h"

namespace indurop::robot {

class JobParser {
 public:
  JobParser(JobBook& book, base::Diagnostics& errors, const ArmShape& shape);
  JobParser(const JobParser&) = delete;
  JobParser& operator=(const JobParser&) = delete;

  // Reads one file as the next job of the book.
  void read(const JobFile& file);
  // The same in parts: begin(), read_line() for each line, end().
  void begin(const JobFile& file);
  void read_line(std::string_view text);
  void end();
  // The words of the language in the line that was read last, in their order.
  [[nodiscard]] const std::vector<JobLine::Keyword>& keywords() const noexcept { return line_.keywords(); }
  // Number of blocks that are open after it.
  [[nodiscard]] std::size_t depth() const noexcept { return blocks_.depth(); }
  // Resolves names; called after all files have been read.
  void resolve() { names_.resolve(); }

 private:
  void statement();

  JobLine line_;
  JobDraft draft_;
  JobNames names_;
  ExpressionReader expressions_;
  PlaceFormulaReader place_formulas_;
  PlaceReader places_;
  ToolReader tools_;
  BodyReader bodies_;
  MotionReader motions_;
  EachPeriodReader each_period_;
  WeaveReader weaving_;
  PushReader pushing_;
  FlowReader flow_;
  ValueReader values_;
  BlockReader blocks_;
};

}  // namespace indurop::robot
