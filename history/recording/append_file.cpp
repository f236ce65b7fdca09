// SPDX-License-Identifier: Apache-2.0
#include "history/recording/append_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <utility>

#include "core/base/file_problem.h"
#include "history/recording/crc32.h"

namespace indurop::recording {
namespace {

base::Problem failed(const std::filesystem::path& path, int error) {
  return {base::cannot_write(path, base::file_problem(error)), error};
}

}  // namespace

Result<AppendFile, base::Problem> AppendFile::create(const std::filesystem::path& path) {
  constexpr mode_t kMode = 0666;
  base::Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode));
  if (!file.is_open() && errno == EEXIST) {
    return base::Problem{path.string() + " exists already; remove it, or give another name"};
  }
  if (!file.is_open()) {
    return failed(path, errno);
  }
  return AppendFile(path, std::move(file));
}

Result<void, base::Problem> AppendFile::append(View bytes) {
  std::uint64_t at = size_;
  for (View rest = bytes; !rest.empty();) {
    const ssize_t written = ::pwrite(file_.get(), rest.data(), rest.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      const int error = written < 0 ? errno : ENOSPC;
      // Best effort: a reader skips a truncated portion.
      (void)!::ftruncate(file_.get(), static_cast<off_t>(size_));
      return failed(path_, error);
    }
    at += static_cast<std::uint64_t>(written);
    rest = rest.subspan(static_cast<std::size_t>(written));
  }
  size_ = at;
  crc_ = crc32(bytes, crc_);
  return {};
}

Result<void, base::Problem> AppendFile::begin_sync() {
  if (syncing_.valid() && syncing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return {};
  }
  const int error = syncing_.valid() ? syncing_.get() : 0;
  syncing_ = std::async(std::launch::async, [file = file_.get()] {
    return ::fdatasync(file) == 0 || errno == EINVAL ? 0 : errno;  // EINVAL: it cannot be synced
  });
  return error == 0 ? Result<void, base::Problem>() : failed(path_, error);
}

Result<void, base::Problem> AppendFile::close() {
  syncing_ = {};
  const int error = ::fsync(file_.get()) != 0 ? errno : 0;
  if (file_.close() != 0 || error != 0) {
    return failed(path_, error != 0 ? error : errno);
  }
  return {};
}

}  // namespace indurop::recording
