// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/program.h"

#include <algorithm>
#include <utility>

#include "control/robot/files/read_files.h"

namespace indurop::robot {

Program::Program(const Arm& arm, JobBook read, Clearance made)
    : book(std::move(read)),
      clearance(std::move(made)),
      tools(arm, book.tips()),
      planned(clearance, true),
      followed(clearance, false),
      unplanned(clearance, false),
      to_rest(clearance, false) {}

Result<std::unique_ptr<Program>, base::Problem> read_program(const FileNames& names, const std::string& urdf) {
  ReadFiles read = read_files(names);
  if (!read.errors.empty()) {
    base::Diagnostic first = read.errors.front();
    first.file = first.file.substr(first.file.rfind('/') + 1);
    const std::size_t more = read.errors.size() - 1;
    return base::Problem{base::to_string(first) +
                         (more == 0 ? "" : "; " + std::to_string(more) + " more: indurop check")};
  }
  if (read.urdf != urdf) {
    return base::Problem{"the arm's description (property urdf) has changed; restart the node to use it"};
  }
  return std::make_unique<Program>(read.model->arm, std::move(read.book), std::move(read.clearance));
}

}  // namespace indurop::robot
