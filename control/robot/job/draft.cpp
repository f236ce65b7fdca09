// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/draft.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace indurop::robot {

namespace {

std::string name_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  return file.substr(0, file.find('.'));
}

}  // namespace

void JobDraft::begin(const JobFile& file) {
  book_.jobs.push_back({name_of(file.path), file.path, {}, {}, 0});
}

Step& JobDraft::add(Op op) {
  Step step;
  step.op = op;
  step.line = static_cast<std::uint32_t>(line_.number());
  job().steps.push_back(step);
  return job().steps.back();
}

int JobDraft::keep(Formula formula) const {
  book_.formulas.push_back(std::move(formula));
  return static_cast<int>(book_.formulas.size()) - 1;
}

int JobDraft::variable_called(std::string_view name) const noexcept {
  const std::vector<std::string>& variables = job().variables;
  const auto found = std::find(variables.begin(), variables.end(), name);
  return found == variables.end() ? -1 : static_cast<int>(found - variables.begin());
}

}  // namespace indurop::robot
