// SPDX-License-Identifier: Apache-2.0
#include "core/base/file_problem.h"

#include <system_error>

namespace indurop::base {

FileProblem file_problem(int error) {
  return {FileProblem::Kind::System, error, std::generic_category().message(error)};
}

std::string cannot_read(const std::filesystem::path& file, const FileProblem& problem) {
  return "cannot read " + file.string() + ": " + problem.text;
}

std::string cannot_write(const std::filesystem::path& file, const FileProblem& problem) {
  return "cannot write " + file.string() + ": " + problem.text;
}

}  // namespace indurop::base
