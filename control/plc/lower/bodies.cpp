// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/bodies.h"

#include <algorithm>

#include "control/plc/lower/chart.h"
#include "control/plc/lower/pou.h"

namespace indurop::plc::lower {

void lower_bodies(std::vector<st::WrittenBody>& bodies, Project& project, const ReadOptions& options,
                  Diagnostics& diagnostics) {
  if (std::any_of(bodies.begin(), bodies.end(), [](const st::WrittenBody& one) { return has_chart(one.code); })) {
    project.types.push_back(step_type());
  }
  for (st::WrittenBody& one : bodies) {
    ast::Pou& pou = project.pous[one.pou];
    ast::Pou& whose = one.method ? pou.methods[*one.method] : pou;
    lower_pou(one.code, options, project, whose, diagnostics);
    if (one.method && whose.c_code && !pou.c_code) {
      pou.c_code = whose.c_code;
    }
  }
}

}  // namespace indurop::plc::lower
