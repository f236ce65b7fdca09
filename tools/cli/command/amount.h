// SPDX-License-Identifier: Apache-2.0
// An amount of something that grows with time: "10min" or "100MB".

#pragma once

#include <cstdint>
#include <string>

#include "core/base/options.h"

namespace indurop::tools {

// Sets one of the two and the other to 0. Returns what is wrong with the text, else an empty text.
std::string read_amount(const std::string& text, std::int64_t& time_ns, std::uint64_t& bytes);

base::Option add_amount_option(base::Options& app, const std::string& names, std::int64_t& time_ns,
                               std::uint64_t& bytes, const std::string& help);

}  // namespace indurop::tools
