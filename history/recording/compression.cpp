// SPDX-License-Identifier: Apache-2.0
#include "history/recording/compression.h"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

namespace indurop::recording {
namespace {

using base::Problem;

// Half the size of lz4's output, at a speed that hardly affects a recorder.
constexpr int kLevel = 1;

Problem damaged(std::string_view compression, std::string_view why) {
  return {fmt::format("data compressed by {} is damaged ({})", compression, why)};
}

// Checks the size that the bytes announce before memory is reserved for it. A zstd block has at least 4 bytes and
// decompresses to at most 128 KiB; one byte of lz4 gives at most 255.
bool possible(std::string_view compression, View bytes, std::uint64_t size) {
  if (compression == "lz4") {
    return size / 255 <= bytes.size();
  }
  const unsigned long long metadata_values = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  return metadata_values != ZSTD_CONTENTSIZE_ERROR && size / (std::uint64_t{32} << 10U) <= bytes.size() &&
         (metadata_values == ZSTD_CONTENTSIZE_UNKNOWN || metadata_values <= size);
}

std::optional<Problem> undo_zstd(View bytes, Block& to) {
  const std::size_t size = ZSTD_decompress(to.bytes.get(), to.size, bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0) {
    return damaged("zstd", ZSTD_getErrorName(size));
  }
  return size == to.size ? std::nullopt : std::optional(damaged("zstd", "too short"));
}

std::optional<Problem> undo_lz4(View bytes, Block& to) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    return Problem{"no memory for lz4"};
  }
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(made,
                                                                                     &LZ4F_freeDecompressionContext);
  std::uint64_t done = 0;
  std::size_t hint = 1;
  while (!bytes.empty()) {
    std::size_t room = to.size - done;
    std::size_t used = bytes.size();
    hint = LZ4F_decompress(context.get(), to.bytes.get() + done, &room, bytes.data(), &used, nullptr);
    if (LZ4F_isError(hint) != 0) {
      return damaged("lz4", LZ4F_getErrorName(hint));
    }
    if (room == 0 && used == 0) {
      return damaged("lz4", "too long");
    }
    done += room;
    bytes = bytes.subspan(used);
  }
  return hint == 0 && done == to.size ? std::nullopt : std::optional(damaged("lz4", "too short"));
}

}  // namespace

ZstdCompressor::ZstdCompressor() : context_(ZSTD_createCCtx()) {}

void ZstdCompressor::Free::operator()(ZSTD_CCtx_s* context) const noexcept {
  ZSTD_freeCCtx(context);
}

Result<View, Problem> ZstdCompressor::compress(View bytes) {
  compressed_.resize(std::max(compressed_.size(), ZSTD_compressBound(bytes.size())));
  const std::size_t size = context_ == nullptr
                               ? std::size_t{0}
                               : ZSTD_compressCCtx(context_.get(), compressed_.data(), compressed_.size(), bytes.data(),
                                                   bytes.size(), kLevel);
  if (size == 0 || ZSTD_isError(size) != 0) {
    return Problem{fmt::format("cannot compress: {}", size == 0 ? "no memory" : ZSTD_getErrorName(size))};
  }
  return View(compressed_).first(size);
}

Block make_block(std::uint64_t size) {
  return {std::make_unique_for_overwrite<std::uint8_t[]>(size), size};  // NOLINT(modernize-avoid-c-arrays)
}

Result<Block, Problem> decompress(std::string_view compression, View bytes, std::uint64_t size) {
  if (size > kMaxChunkBytes) {
    return Problem{fmt::format("{} bytes are more than the {} that are read at once", size, kMaxChunkBytes)};
  }
  if (compression.empty()) {
    if (bytes.size() != size) {
      return Problem{fmt::format("{} bytes are announced, there are {}", size, bytes.size())};
    }
    // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): the result owns it
    Block block = make_block(size);
    std::copy(bytes.begin(), bytes.end(), block.bytes.get());
    return block;
  }
  if (compression != "zstd" && compression != "lz4") {
    return Problem{fmt::format("compression '{}' is not known; zstd and lz4 are", compression)};
  }
  if (!possible(compression, bytes, size)) {
    return damaged(compression, "its size");
  }
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): the result owns it
  Block block = make_block(size);
  auto problem = compression == "zstd" ? undo_zstd(bytes, block) : undo_lz4(bytes, block);
  if (problem) {
    return *std::move(problem);
  }
  return block;
}

}  // namespace indurop::recording
