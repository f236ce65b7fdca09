// SPDX-License-Identifier: Apache-2.0
// What kinds of modules there are (chapter, Figures 1 and 9), in the words of module.xml. The numbers stand in shared
// memory: append only.

#pragma once

#include <cstddef>
#include <cstdint>

namespace indurop::scheduler {

inline constexpr std::size_t kNameLength = 96;  // of a module, with the final 0

enum class ModuleType : std::uint32_t { Thread, Process };
enum class Operation : std::uint32_t { Periodic, Sporadic, NonReal };
enum class OverrunPolicy : std::uint32_t { Skip, CatchUp, StopModule, StopNode };

}  // namespace indurop::scheduler
