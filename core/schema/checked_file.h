// SPDX-License-Identifier: Apache-2.0
// A file whose contents are not trusted: no read goes beyond the size that it had when it was opened.

#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/read_file.h"

namespace indurop::schema {

class CheckedFile {
 public:
  explicit CheckedFile(base::OpenFile opened) noexcept : opened_(std::move(opened)) {}

  [[nodiscard]] bool holds(std::uint64_t offset, std::uint64_t length) const noexcept {
    return offset <= opened_.size && length <= opened_.size - offset;
  }
  [[nodiscard]] bool read(std::uint64_t offset, void* to, std::uint64_t length) const {
    if (!holds(offset, length)) {
      return false;
    }
    auto* at = static_cast<char*>(to);
    while (length > 0) {
      const ssize_t got = ::pread(opened_.file.get(), at, length, static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) {
        continue;
      }
      if (got <= 0) {
        return false;
      }
      at += got;
      offset += static_cast<std::uint64_t>(got);
      length -= static_cast<std::uint64_t>(got);
    }
    return true;
  }
  // Reads `count` consecutive records; nothing if the file is too short or there are too many.
  template <class T>
  [[nodiscard]] std::optional<std::vector<T>> table(std::uint64_t offset, std::uint64_t count) const {
    if (count > kMaxTable / sizeof(T) || !holds(offset, count * sizeof(T))) {
      return std::nullopt;
    }
    std::optional<std::vector<T>> rows(std::in_place, count);
    if (!read(offset, rows->data(), count * sizeof(T))) {
      rows.reset();
    }
    return rows;
  }

  static constexpr std::uint64_t kMaxTable = std::uint64_t{256} << 20U;  // bytes

 private:
  base::OpenFile opened_;
};

}  // namespace indurop::schema
