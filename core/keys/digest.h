// SPDX-License-Identifier: Apache-2.0
// SHA-256, which identifies files and deployments.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/file_problem.h"

namespace indurop::keys {

class Digest {
 public:
  Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;
  ~Digest();
  void add(std::span<const std::uint8_t> bytes);
  // Returns 64 lower-case hexadecimal digits for all bytes that were added. The object must not be used afterwards.
  [[nodiscard]] std::string finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

std::string digest_of(std::string_view text);
// Digest and size of a file's content.
struct FileDigest {
  std::string digest;
  std::uint64_t size = 0;
};
Result<FileDigest, base::FileProblem> digest_of_file(const std::filesystem::path& file);
// Returns true for 64 lower-case hexadecimal digits.
bool is_digest(std::string_view text) noexcept;

}  // namespace indurop::keys
