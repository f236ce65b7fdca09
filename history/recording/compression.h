// SPDX-License-Identifier: Apache-2.0
// The compressions of MCAP chunks: "zstd", which we write, "lz4" (its frame format), which third-party programs write,
// and "" for none.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <string_view>

#include "core/base/problem.h"
#include "history/recording/records.h"

struct ZSTD_CCtx_s;

namespace indurop::recording {

class ZstdCompressor {
 public:
  ZstdCompressor();
  // The result is valid until the next call. Errors: out of memory.
  Result<View, base::Problem> compress(View bytes);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const noexcept;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
  Bytes compressed_;
};

// Uninitialized bytes: memory reserved for a damaged file costs nothing until it is filled.
struct Block {
  std::unique_ptr<std::uint8_t[]> bytes;  // NOLINT(modernize-avoid-c-arrays)
  std::uint64_t size = 0;
  [[nodiscard]] View view() const { return {bytes.get(), size}; }
};
Block make_block(std::uint64_t size);

// Decompresses; the result must have `size` bytes, at most kMaxChunkBytes. Errors: unknown compression; `bytes` do not
// decompress to that size.
Result<Block, base::Problem> decompress(std::string_view compression, View bytes, std::uint64_t size);

}  // namespace indurop::recording
