// SPDX-License-Identifier: Apache-2.0

#include "store/vars/run_file.h"

#include <algorithm>

namespace indurop::vars {

namespace {
constexpr Error kBadName{Errc::InvalidArgument, 0, "node name: 1 to 40 letters, digits, '_' or '-'"};
}

Result<RunFile> RunFile::create(const std::string& node, std::size_t size) {
  if (!valid_node_name(node)) {
    return kBadName;
  }
  auto file = ShmFile::create(run_file(node), std::max(size, sizeof(std::uint64_t)));
  if (!file) {
    return file.error();
  }
  if (Status status = file->publish(); !status) {
    return status.error();
  }
  return RunFile(std::move(file.value()));
}

Result<RunFile> RunFile::open(const std::string& node, Mode mode, std::uint64_t magic, std::size_t smallest) {
  if (!valid_node_name(node)) {
    return kBadName;
  }
  auto file = ShmFile::open(run_file(node), mode);
  if (!file) {
    return file.error();
  }
  if (file->size() < std::max(smallest, sizeof(magic))) {
    return Error{Errc::Corrupt, 0, "run block is too short"};
  }
  const std::uint64_t found = __atomic_load_n(reinterpret_cast<const std::uint64_t*>(file->data()), __ATOMIC_ACQUIRE);
  if (found == 0) {
    return Error{Errc::Busy, 0, "run block is being set up"};
  }
  if (found != magic) {
    return Error{Errc::Corrupt, 0, "not a run block"};
  }
  return RunFile(std::move(file.value()));
}

}  // namespace indurop::vars
