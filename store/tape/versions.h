// SPDX-License-Identifier: Apache-2.0
// The versions of modules' code on a tape: each run carries the number of the one that ran, and the tape says from
// which file it was loaded, so that the run can be repeated with the same file. Not real-time safe.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "store/tape/layout.h"

namespace indurop::tape {

struct Version {
  std::uint32_t number = 0;
  std::uint32_t module = 0;  // index in the run block
  bool of_start = false;     // the node started with it; else it came by an exchange
  std::string digest;        // SHA-256 of its file
  std::string file;          // path with which it was loaded; empty: not known
};

// The number of the version that a run is one of; 0: not known.
constexpr std::uint32_t version_in(std::uint32_t run_flags) noexcept {
  return run_flags >> kVersionShift;
}

// The writing end, of the node. One thread.
class VersionTable {
 public:
  VersionTable() = default;
  // `memory`: of the tape, kLaterVersions places after those of the start; borrowed.
  VersionTable(std::span<TapeVersion> memory) noexcept : memory_(memory) {}

  // Notes the version with which the node started. Returns its number; 0: there is no place for this module.
  std::uint32_t add_first(std::uint32_t module, const std::string& digest, const std::string& file) noexcept;
  // Notes one that was loaded later, in the place of the oldest of these. Returns its number; 0: there are none left.
  std::uint32_t add(std::uint32_t module, const std::string& digest, const std::string& file) noexcept;

 private:
  void write(std::size_t place, std::uint32_t number, const Version& version) noexcept;
  std::span<TapeVersion> memory_;
  std::uint32_t added_ = 0;  // later ones
};

// The reading end: returns nothing if the version's place was taken by a later one. `start`: number of places for
// versions of the start.
std::optional<Version> find_version(std::span<const TapeVersion> memory, std::uint32_t start, std::uint32_t number);

}  // namespace indurop::tape
