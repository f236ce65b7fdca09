// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/draft.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "control/robot/job/constants.h"

namespace indurop::robot {

namespace {

std::string name_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  return file.substr(0, file.find('.'));
}

}  // namespace

void JobDraft::begin(const JobFile& file) {
  Job job;
  job.name = name_of(file.path);
  job.file = file.path;
  book_.jobs.push_back(std::move(job));
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

int JobDraft::keep(std::vector<Formula> formulas) const {
  const int first = formulas.empty() ? -1 : static_cast<int>(book_.formulas.size());
  std::move(formulas.begin(), formulas.end(), std::back_inserter(book_.formulas));
  return first;
}

int JobDraft::signal(const JobToken& name, bool set) const {
  const auto index = static_cast<std::size_t>(std::find(book_.signals.begin(), book_.signals.end(), name.text) -
                                              book_.signals.begin());
  if (index == book_.signals.size()) {
    book_.signals.emplace_back(name.text);
  }
  if (std::none_of(book_.named.begin(), book_.named.end(),
                   [&](const NamedVariable& one) { return one.name == name.text && one.set == set; })) {
    book_.named.push_back({std::string(name.text), line_.file(), line_.place(name), set});
  }
  return static_cast<int>(index);
}

int JobDraft::add_hidden(std::size_t count) const {
  const int first = static_cast<int>(job().variables.size());
  job().variables.resize(job().variables.size() + count);
  return first;
}

int JobDraft::array_at(int variable) const noexcept {
  const auto found = std::find_if(job().arrays.begin(), job().arrays.end(),
                                  [&](const Job::Array& each) { return each.first == variable; });
  return found == job().arrays.end() ? 0 : found->size;
}

int JobDraft::variable_called(std::string_view name) const noexcept {
  const std::vector<std::string>& variables = job().variables;
  const auto found = std::find(variables.begin(), variables.end(), name);
  return found == variables.end() ? -1 : static_cast<int>(found - variables.begin());
}

std::optional<double> JobDraft::constant(int formula) const {
  return formula < 0 ? std::nullopt : constant_of(book_.formulas[static_cast<std::size_t>(formula)]);
}

}  // namespace indurop::robot
