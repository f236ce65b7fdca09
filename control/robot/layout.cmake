# Writes a header with a number that differs if any of the HEADERS has changed: cmake -DHEADERS=... -DTO=... -P
set(all "")
foreach(header ${HEADERS})
  file(SHA256 ${header} hash)
  string(APPEND all ${hash})
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)
file(WRITE ${TO} "// Written by control/robot/layout.cmake: the layout of all types of the robot task.
#pragma once
#include <cstdint>
namespace indurop::robot {
inline constexpr std::uint64_t kLayoutOfRobot = 0x${hash}ULL;
}  // namespace indurop::robot
")
