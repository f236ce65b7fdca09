// SPDX-License-Identifier: Apache-2.0
// One variable of abi::Kind::Scalar addressed by bytes: for tools and files. Modules use atomics directly.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace indurop::vars {

// `size` is 1, 2, 4 or 8; [offset, offset + span size) lies inside it. Real-time safe.
void read_scalar(const std::byte* entry, std::uint32_t size, std::uint32_t offset, std::span<std::uint8_t> to) noexcept;
// Writes a part and leaves the rest unchanged, in one atomic step.
void write_scalar(std::byte* entry, std::uint32_t size, std::uint32_t offset,
                  std::span<const std::uint8_t> from) noexcept;

}  // namespace indurop::vars
