// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/fetcher.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <set>
#include <utility>

#include "deploy/words/deployment_words.h"

namespace indurop::deploy {
namespace {

using base::Problem;

constexpr std::uint64_t kLargestPackage = 16U << 20U;
constexpr std::uint64_t kReserve = 1U << 20U;  // left free on the disk
constexpr std::chrono::seconds kSilent{3};     // timeout before another source is asked

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

void Fetcher::begin_file(std::uint64_t source, Wanted file) {
  begin_with({source}, file.digest);
  planned_ = true;
  if (!state_.has_sound(file.digest, file.name)) {
    wanted_.push_back(std::move(file));
  }
}

void Fetcher::begin_with(std::vector<std::uint64_t> sources, const std::string& id) {
  cancel();
  sources_ = std::move(sources);
  source_ = 0;
  without_.clear();
  last_progress_ = {};
  id_ = id;
  active_ = true;
  planned_ = false;
  again_ = false;
  problem_.clear();
  progress_ = {};
  at_ = 0;
  wanted_.clear();
}

void Fetcher::begin(std::vector<std::uint64_t> sources, const std::string& id, std::uint64_t size) {
  begin_with(std::move(sources), id);
  if (!keys::is_digest(id) || size > kLargestPackage) {
    problem_ = "the deployment offered has no valid id or size";
  } else if (const bool here = state_.has_sound(id, "the package"); !here && size == 0) {
    problem_ = fmt::format(
        "the package of deployment {} (SHA-256 {}) is not on this board as it was deployed, and none of the boards "
        "that were asked has it: deploy its files again (indurop deploy)",
        shown_id(id), id);
  } else if (!here) {
    wanted_.push_back({id, size, "the package"});
  }
}

void Fetcher::cancel() {
  close_part();
  active_ = false;
}

FetchProgress Fetcher::progress() const noexcept {
  FetchProgress now = progress_;
  now.bytes_done += planned_ && blob_ ? blob_->have() : 0;
  return now;
}

// The package is complete: determines which of its files are missing.
Fetcher::Attempt Fetcher::plan_files() {
  const auto package = state_.package(id_);
  if (!package) {
    return package.error();
  }
  if (auto taken = state_.reserve().take(); !taken) {
    return taken;
  }
  planned_ = true;
  wanted_.clear();
  at_ = 0;
  std::set<std::string> seen;
  const bool needed = !package->release.empty() ||
                      std::find(package->boards.begin(), package->boards.end(), board_) != package->boards.end();
  for (const PackageFile& file : package->files) {
    if (needed && seen.insert(file.digest).second && !state_.restore(id_, file)) {
      wanted_.push_back({file.digest, file.size, file.path});
      progress_.bytes += file.size;
    }
  }
  progress_.files = static_cast<std::uint32_t>(wanted_.size());
  struct statvfs disk {};
  if (::statvfs(state_.folder().c_str(), &disk) == 0) {
    const std::uint64_t free = std::uint64_t{disk.f_bavail} * disk.f_frsize;
    if (progress_.bytes > 0 && free < progress_.bytes + kReserve) {
      return Problem{fmt::format("disk full: {:.1f} MiB are needed in {}, {:.1f} MiB are free",
                                 mib(progress_.bytes + kReserve), state_.folder().string(), mib(free))};
    }
  }
  return {};
}

Fetcher::Attempt Fetcher::open_part(const Wanted& wanted) {
  const auto path = state_.part(wanted.digest);
  part_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0640);
  if (part_ < 0) {
    return Problem{fmt::format("cannot write {}: {}", path.string(), std::strerror(errno))};
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
      return Problem{fmt::format("cannot write {}: {}", path.string(), std::strerror(errno))};
    }
  }
  (void)::lseek(part_, static_cast<off_t>(have), SEEK_SET);
  blob_.emplace(wanted.size, have, room_);
  return {};
}

Fetcher::Attempt Fetcher::take(const BlobChunk& chunk, rt::MonoTime now) {
  const Wanted& wanted = wanted_[at_];
  if (chunk.source != sources_[source_] || chunk.blob != wanted.digest) {
    return {};
  }
  last_progress_ = now;
  if (chunk.missing) {
    return next_source();
  }
  if (!blob_->take(chunk.offset, chunk.data.size(), now)) {
    return {};
  }
  std::size_t written = 0;
  while (written < chunk.data.size()) {
    const ssize_t n = ::write(part_, chunk.data.data() + written, chunk.data.size() - written);
    if (n <= 0) {
      return Problem{fmt::format("{}: {} cannot be written in {}", errno == ENOSPC ? "disk full" : std::strerror(errno),
                                 wanted.name, state_.folder().string())};
    }
    written += static_cast<std::size_t>(n);
  }
  digest_->add(chunk.data);
  return {};
}

// The current source does not have the file with the right content.
Fetcher::Attempt Fetcher::next_source() {
  without_.insert(source_);
  if (without_.size() == sources_.size()) {
    return Problem{fmt::format(
        "{} (SHA-256 {}) is not on this board as it was deployed, and none of the boards that were asked has it",
        wanted_[at_].name, wanted_[at_].digest)};
  }
  ask_another();
  return {};
}

void Fetcher::ask_another() {
  close_part();
  do {
    source_ = (source_ + 1) % sources_.size();
  } while (without_.contains(source_));
}

Fetcher::Attempt Fetcher::finish_part() {
  const Wanted& wanted = wanted_[at_];
  const bool sound = digest_->finish() == wanted.digest;
  close_part();
  if (!sound) {
    ::unlink(state_.part(wanted.digest).c_str());
    again_ = !again_;  // the part may be a leftover of a crash; the second time, the source has a different file
    return again_ ? Attempt{} : next_source();
  }
  again_ = false;
  without_.clear();
  if (auto kept = state_.keep(wanted.digest); !kept) {
    return kept;
  }
  if (planned_) {
    ++progress_.files_done;
    progress_.bytes_done += wanted.size;
  }
  ++at_;
  return {};
}

// Opens parts until one needs data from the network, or all are complete.
Fetcher::Attempt Fetcher::open_next() {
  for (;;) {
    if (at_ == wanted_.size()) {
      if (planned_) {
        return {};
      }
      if (auto planned = plan_files(); !planned) {
        return planned;
      }
      continue;
    }
    if (!blob_) {
      if (auto opened = open_part(wanted_[at_]); !opened) {
        return opened;
      }
    }
    if (!blob_->complete()) {
      return {};
    }
    if (auto finished = finish_part(); !finished) {
      return finished;
    }
  }
}

Fetcher::Attempt Fetcher::advance(DeployLink& link, rt::MonoTime now) {
  auto done = open_next();
  for (const BlobChunk& chunk : link.take_chunks()) {
    if (!done || !blob_) {
      break;
    }
    done = take(chunk, now);
    if (done) {
      done = open_next();
    }
  }
  return done;
}

Fetcher::State Fetcher::step(DeployLink& link, rt::MonoTime now) {
  room_ = link.room();
  if (problem_.empty()) {
    if (auto advanced = advance(link, now); !advanced) {
      problem_ = advanced.error().text;
    }
  }
  if (!problem_.empty() || (planned_ && at_ == wanted_.size())) {
    cancel();
    return problem_.empty() ? State::Done : State::Failed;
  }
  if (last_progress_ == rt::MonoTime{}) {
    last_progress_ = now;
  }
  if (now - last_progress_ > kSilent) {
    last_progress_ = now;
    ask_another();
    return State::Working;
  }
  if (const auto range = blob_->ask(now)) {
    link.request({self_, sources_[source_], wanted_[at_].digest, range->offset, range->length, range->restart});
  }
  return State::Working;
}

}  // namespace indurop::deploy
