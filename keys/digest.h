// SPDX-License-Identifier: Apache-2.0
// SHA-256, by which files and deployments are named.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/file_problem.h"

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
  // 64 lower-case hexadecimal digits of all that was added. Ends the use of the object.
  [[nodiscard]] std::string finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

std::string digest_of(std::string_view text);
// Of a file's content.
struct FileDigest {
  std::string digest;
  std::uint64_t size = 0;
};
Result<FileDigest, base::FileProblem> digest_of_file(const std::filesystem::path& file);
// 64 lower-case hexadecimal digits.
bool is_digest(std::string_view text) noexcept;

}  // namespace indurop::keys
