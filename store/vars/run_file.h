// SPDX-License-Identifier: Apache-2.0
// The shared memory of one run of a node, as bytes: their meaning is defined by the creator. The first eight bytes are
// a magic number that the creator stores last, when everything else is in place.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "store/vars/shm_file.h"

namespace indurop::vars {

class RunFile {
 public:
  // Creates zeroed bytes; replaces an older run's file, which processes that have it open keep. Only the holder of the
  // node lock may call it. Errors: InvalidArgument (node name), NoSpace, PermissionDenied (the older file is another
  // user's), System. On error no file is left.
  static Result<RunFile> create(const std::string& node, std::size_t size);

  // Errors: InvalidArgument (node name), NotFound, PermissionDenied, Corrupt (shorter than `smallest`, or another
  // magic), Busy (being set up: try again), System.
  static Result<RunFile> open(const std::string& node, Mode mode, std::uint64_t magic, std::size_t smallest);

  [[nodiscard]] void* data() const noexcept { return file_.data(); }  // page aligned
  [[nodiscard]] std::size_t size() const noexcept { return file_.size(); }
  void prefault() const noexcept { file_.prefault(); }
  [[nodiscard]] ShmFile::Named named() const noexcept { return file_.named(); }

 private:
  explicit RunFile(ShmFile&& file) noexcept : file_(std::move(file)) {}
  ShmFile file_;
};

}  // namespace indurop::vars
