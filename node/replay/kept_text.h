// SPDX-License-Identifier: Apache-2.0
// What a module keeps, as text for people: numbers, texts and arrays of them by the name of their type, in C++ or IEC
// 61131-3. Other types are shown as bytes.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace indurop::node {

// `type`: as in StateItem. Not real-time safe.
std::string kept_text(std::string_view type, std::span<const std::uint8_t> bytes);

}  // namespace indurop::node
