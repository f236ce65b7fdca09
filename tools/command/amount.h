// SPDX-License-Identifier: Apache-2.0
// "10min" or "100MB": how much of something that grows with time.

#pragma once

#include <cstdint>
#include <string>

#include "base/options.h"

namespace indurop::tools {

// One of both is set, the other one is 0. Returns what is wrong with the text, else nothing.
std::string read_amount(const std::string& text, std::int64_t& time_ns, std::uint64_t& bytes);

base::Option add_amount_option(base::Options& app, const std::string& names, std::int64_t& time_ns,
                               std::uint64_t& bytes, const std::string& help);

}  // namespace indurop::tools
