// SPDX-License-Identifier: Apache-2.0
#include "node/fetcher.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <set>

#include "deploy/deployment_words.h"

namespace indurop::node {
namespace {

constexpr std::uint64_t kLargestPackage = 16U << 20U;
constexpr std::uint64_t kReserve = 1U << 20U;  // left free on the disk

double mib(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1U << 20U);
}

}  // namespace

Fetcher::~Fetcher() {
  close_part();
}

void Fetcher::close_part() {
  if (part_ >= 0) {
    ::close(part_);
  }
  part_ = -1;
  blob_.reset();
  digest_.reset();
}

void Fetcher::begin(std::uint64_t source, const std::string& id, std::uint64_t size) {
  cancel();
  source_ = source;
  id_ = id;
  active_ = true;
  planned_ = false;
  again_ = false;
  problem_.clear();
  files_ = files_done_ = 0;
  bytes_ = bytes_done_ = 0;
  at_ = 0;
  wanted_.clear();
  if (!deploy::is_digest(id) || size > kLargestPackage) {
    problem_ = "the deployment offered has no sound id or size";
  } else if (!state_.has(id) && size == 0) {
    problem_ = fmt::format("deployment {} is not on this board any more", deploy::shown_id(id));
  } else if (!state_.has(id)) {
    wanted_.push_back({id, size, "the package"});
  }
}

void Fetcher::cancel() {
  close_part();
  active_ = false;
}

bool Fetcher::fail(const std::string& problem) {
  problem_ = problem;
  return false;
}

std::uint64_t Fetcher::bytes_done() const noexcept {
  return bytes_done_ + (planned_ && blob_ ? blob_->have() : 0);
}

// The package is here: which of its files are not?
bool Fetcher::plan_files() {
  std::string problem;
  const auto package = state_.package(id_, problem);
  if (!package) {
    return fail(problem);
  }
  planned_ = true;
  wanted_.clear();
  at_ = 0;
  std::set<std::string> seen;
  const bool needed = std::find(package->boards.begin(), package->boards.end(), board_) != package->boards.end();
  for (const deploy::PackageFile& file : package->files) {
    if (needed && !state_.has(file.digest) && seen.insert(file.digest).second) {
      wanted_.push_back({file.digest, file.size, file.path});
      bytes_ += file.size;
    }
  }
  files_ = static_cast<std::uint32_t>(wanted_.size());
  struct statvfs disk {};
  if (::statvfs(state_.folder().c_str(), &disk) == 0) {
    const std::uint64_t free = std::uint64_t{disk.f_bavail} * disk.f_frsize;
    if (bytes_ > 0 && free < bytes_ + kReserve) {
      return fail(fmt::format("disk full: {:.1f} MiB are needed in {}, {:.1f} MiB are free", mib(bytes_ + kReserve),
                              state_.folder().string(), mib(free)));
    }
  }
  return true;
}

bool Fetcher::open_part(const Wanted& wanted) {
  const auto path = state_.part(wanted.digest);
  part_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (part_ < 0) {
    return fail(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  }
  digest_.emplace();
  std::uint64_t have = 0;
  std::array<std::uint8_t, 65536> block{};
  ssize_t got = 0;
  while ((got = ::read(part_, block.data(), block.size())) > 0) {
    digest_->add({block.data(), static_cast<std::size_t>(got)});
    have += static_cast<std::uint64_t>(got);
  }
  if (have > wanted.size) {
    have = 0;
    digest_.emplace();
    if (::ftruncate(part_, 0) != 0) {
      return fail(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
    }
  }
  (void)::lseek(part_, static_cast<off_t>(have), SEEK_SET);
  blob_.emplace(wanted.size, have, room_);
  return true;
}

bool Fetcher::take(const deploy::BlobChunk& chunk, std::int64_t now_ns) {
  const Wanted& wanted = wanted_[at_];
  if (chunk.source != source_ || chunk.blob != wanted.digest) {
    return true;
  }
  if (chunk.missing) {
    return fail(fmt::format("{} is not where it was offered", wanted.name));
  }
  if (!blob_->take(chunk.offset, chunk.data.size(), now_ns)) {
    return true;
  }
  std::size_t written = 0;
  while (written < chunk.data.size()) {
    const ssize_t n = ::write(part_, chunk.data.data() + written, chunk.data.size() - written);
    if (n <= 0) {
      return fail(fmt::format("{}: {} cannot be written in {}", errno == ENOSPC ? "disk full" : std::strerror(errno),
                              wanted.name, state_.folder().string()));
    }
    written += static_cast<std::size_t>(n);
  }
  digest_->add(chunk.data);
  return true;
}

bool Fetcher::finish_part() {
  const Wanted& wanted = wanted_[at_];
  const bool sound = digest_->finish() == wanted.digest;
  close_part();
  if (!sound) {
    ::unlink(state_.part(wanted.digest).c_str());
    if (again_) {
      return fail(fmt::format("{} did not arrive as it was sent (SHA-256 differs)", wanted.name));
    }
    again_ = true;  // the part may be a leftover of a crash
    return true;
  }
  again_ = false;
  if (const std::string problem = state_.keep(wanted.digest); !problem.empty()) {
    return fail(problem);
  }
  if (planned_) {
    ++files_done_;
    bytes_done_ += wanted.size;
  }
  ++at_;
  return true;
}

// Opens parts until one needs something from the network, or all is here.
bool Fetcher::open_next() {
  for (;;) {
    if (at_ == wanted_.size()) {
      if (planned_) {
        return true;
      }
      if (!plan_files()) {
        return false;
      }
      continue;
    }
    if (!blob_ && !open_part(wanted_[at_])) {
      return false;
    }
    if (!blob_->complete()) {
      return true;
    }
    if (!finish_part()) {
      return false;
    }
  }
}

Fetcher::Result Fetcher::step(mirror::DeployLink& link, std::int64_t now_ns) {
  room_ = link.room();
  bool ok = problem_.empty() && open_next();
  if (ok) {
    for (const deploy::BlobChunk& chunk : link.take_chunks()) {
      if (!ok || !blob_) {
        break;
      }
      ok = take(chunk, now_ns) && open_next();
    }
  }
  if (!ok || (planned_ && at_ == wanted_.size())) {
    cancel();
    return ok ? Result::Done : Result::Failed;
  }
  if (const auto range = blob_->ask(now_ns)) {
    link.request({self_, source_, wanted_[at_].digest, range->offset, range->length, range->restart});
  }
  return Result::Working;
}

}  // namespace indurop::node
