// SPDX-License-Identifier: Apache-2.0
#include "deploy/disk/disk_reserve.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstring>

namespace indurop::deploy {
namespace {

constexpr off_t kSize = 256L * 1024;                           // some ten times what is written
constexpr std::uintmax_t kAnswer = std::uintmax_t{16} * 1024;  // that of a node is smaller
constexpr mode_t kMode = 0600;

}  // namespace

Result<void, base::Problem> DiskReserve::take() const {
  const int file = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, kMode);
  int error = file < 0 ? errno : ::posix_fallocate(file, 0, kSize);
  if (file >= 0) {
    ::close(file);
  }
  if (error == 0) {
    return {};
  }
  give();
  return base::Problem{fmt::format("{}: a deployment needs {} KiB in {}",
                                   error == ENOSPC ? "disk full" : std::strerror(error), kSize / 1024,
                                   file_.parent_path().string())};
}

void DiskReserve::give_if_full() const noexcept {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(file_.parent_path(), error);
  if (!error && space.available < kAnswer) {
    give();
  }
}

void DiskReserve::give() const noexcept {
  ::unlink(file_.c_str());
}

}  // namespace indurop::deploy
