// SPDX-License-Identifier: Apache-2.0
#include "store/tape/versions.h"

#include <atomic>
#include <utility>

#include "core/rt/copy_text.h"
#include "core/rt/fixed_text.h"
#include "core/rt/relaxed.h"

namespace indurop::tape {
namespace {

// Place of a number: the first `start` numbers have their own, the others take turns.
std::size_t place_of(std::uint32_t start, std::uint32_t number) noexcept {
  return number <= start ? number - 1 : start + (number - start - 1) % kLaterVersions;
}

}  // namespace

std::uint32_t VersionTable::add_first(std::uint32_t module, const std::string& digest,
                                      const std::string& file) noexcept {
  if (module + kLaterVersions >= memory_.size() || module >= kMaxVersionNumber) {
    return 0;
  }
  write(module, module + 1, {module + 1, module, true, digest, file});
  return module + 1;
}

std::uint32_t VersionTable::add(std::uint32_t module, const std::string& digest, const std::string& file) noexcept {
  if (memory_.empty()) {
    return 0;
  }
  const auto start = static_cast<std::uint32_t>(memory_.size()) - kLaterVersions;
  if (start + added_ >= kMaxVersionNumber) {
    return 0;
  }
  const std::uint32_t number = start + ++added_;
  write(place_of(start, number), number, {number, module, false, digest, file});
  return number;
}

void VersionTable::write(std::size_t place, std::uint32_t number, const Version& version) noexcept {
  TapeVersion& to = memory_[place];
  to.number.store(0, rt::kRelaxed);
  std::atomic_thread_fence(std::memory_order_seq_cst);  // before what follows
  to.module = version.module;
  rt::copy_text(to.digest, version.digest);
  rt::copy_text(to.file, version.file.size() < sizeof to.file ? version.file : "");
  to.number.store(number, std::memory_order_release);
}

std::optional<Version> find_version(std::span<const TapeVersion> memory, std::uint32_t start, std::uint32_t number) {
  if (number == 0 || start + std::size_t{kLaterVersions} != memory.size()) {
    return std::nullopt;
  }
  const TapeVersion& from = memory[place_of(start, number)];
  if (from.number.load(std::memory_order_acquire) != number) {
    return std::nullopt;
  }
  Version version{number, from.module, number <= start, rt::text_of(from.digest), rt::text_of(from.file)};
  std::atomic_thread_fence(std::memory_order_acquire);
  return from.number.load(rt::kRelaxed) == number ? std::optional(std::move(version)) : std::nullopt;
}

}  // namespace indurop::tape
