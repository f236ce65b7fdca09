// SPDX-License-Identifier: Apache-2.0
// The kinds of modules (chapter, Figures 1 and 9), named as in module.xml. The numbers are stored in shared memory:
// append only.

#pragma once

#include <cstddef>
#include <cstdint>

namespace indurop::scheduler {

inline constexpr std::size_t kNameLength = 96;  // maximum length of a module's name, with the final 0

enum class ModuleType : std::uint32_t { Thread, Process };
enum class Operation : std::uint32_t { Periodic, Sporadic, NonReal };
enum class OverrunPolicy : std::uint32_t { Skip, CatchUp, StopModule, StopNode };

}  // namespace indurop::scheduler
