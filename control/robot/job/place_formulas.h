// SPDX-License-Identifier: Apache-2.0
// Places that jobs compute: "camera : POSE x, y, 0 RPY 0, 0, a", "INV(pallet) : HERE", "POSE 0, 0, h IN pallet".

#pragma once

#include <vector>

#include "control/robot/job/draft.h"
#include "control/robot/job/expression.h"
#include "control/robot/job/line.h"
#include "control/robot/job/names.h"

namespace indurop::robot {

class PlaceFormulaReader {
 public:
  PlaceFormulaReader(JobLine& line, JobDraft& draft, JobNames& names, ExpressionReader& expressions)
      : line_(line), draft_(draft), names_(names), expressions_(expressions) {
    expressions_.use(*this);
  }

  // Returns whether the line continues with a place, which a number cannot begin with.
  [[nodiscard]] bool at_place() const;
  // Reads a place. Returns its index in the book.
  int read();
  // Reads the first place relative to the second one, "DIST(A, B)" after the bracket. Returns its index in the book.
  int read_difference();

 private:
  // A place that is being read; names get their index when all of it is known.
  struct Draft {
    std::vector<PlacePart> parts{};
    struct Name {
      std::size_t part = 0;
      JobToken token;
    };
    std::vector<Name> names{};
    Reads reads{};
    std::size_t depth = 0, deepest = 0;
    void push(PlaceOp op, int index = -1);
  };

  void product(Draft& draft, int brackets);
  void factor(Draft& draft, int brackets);
  void pose(Draft& draft);
  void name(Draft& draft);
  std::vector<Formula> numbers(const char* what, Reads& reads);
  int keep(Draft& draft, const JobToken& start);

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
};

}  // namespace indurop::robot
