// SPDX-License-Identifier: Apache-2.0
#include "core/keys/digest.h"

#include <openssl/evp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <vector>

#include "core/base/hexadecimal.h"
#include "core/base/read_file.h"

namespace indurop::keys {
namespace {

constexpr std::size_t kBlock = std::size_t{256} * 1024;
constexpr std::size_t kDigits = 64;

}  // namespace

struct Digest::Impl {
  Impl() : context(::EVP_MD_CTX_new(), &::EVP_MD_CTX_free) {
    if (context == nullptr || ::EVP_DigestInit_ex(context.get(), ::EVP_sha256(), nullptr) != 1) {
      std::abort();  // out of memory, or a libcrypto without SHA-256
    }
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&::EVP_MD_CTX_free)> context;
};

Digest::Digest() : impl_(std::make_unique<Impl>()) {}
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;
Digest::~Digest() = default;

void Digest::add(std::span<const std::uint8_t> bytes) {
  (void)::EVP_DigestUpdate(impl_->context.get(), bytes.data(), bytes.size());
}

std::string Digest::finish() {
  std::array<std::uint8_t, EVP_MAX_MD_SIZE> raw{};
  unsigned int length = 0;
  (void)::EVP_DigestFinal_ex(impl_->context.get(), raw.data(), &length);
  return base::in_hexadecimal({raw.data(), length});
}

std::string digest_of(std::string_view text) {
  Digest digest;
  digest.add({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  return digest.finish();
}

Result<FileDigest, base::FileProblem> digest_of_file(const std::filesystem::path& file) {
  auto opened = base::open_file(file);
  if (!opened) {
    return std::move(opened).error();
  }
  std::uint64_t size = 0;
  Digest digest;
  std::vector<std::uint8_t> block(kBlock);
  while (true) {
    const ssize_t got = ::read(opened->file.get(), block.data(), block.size());
    if (got < 0 && errno != EINTR) {
      return base::file_problem(errno);
    }
    if (got == 0) {
      return FileDigest{digest.finish(), size};
    }
    const std::size_t count = got < 0 ? 0 : static_cast<std::size_t>(got);
    digest.add({block.data(), count});
    size += count;
  }
}

bool is_digest(std::string_view text) noexcept {
  return text.size() == kDigits &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

}  // namespace indurop::keys
