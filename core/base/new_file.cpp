// SPDX-License-Identifier: Apache-2.0
#include "core/base/new_file.h"

#include <fcntl.h>

#include <cerrno>

#include "core/base/write_all.h"

namespace indurop::base {

NewFile::NewFile(const std::filesystem::path& path) noexcept
    : file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)),
      error_(file_.is_open() ? 0 : errno) {}

bool NewFile::write(std::string_view bytes) noexcept {
  if (good()) {
    error_ = write_all(file_.get(), bytes);
  }
  return good();
}

Result<void, FileProblem> NewFile::close() {
  if (file_.close() != 0 && error_ == 0) {
    error_ = errno;
  }
  return error_ == 0 ? Result<void, FileProblem>() : Result<void, FileProblem>(file_problem(error_));
}

}  // namespace indurop::base
