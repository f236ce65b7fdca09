// SPDX-License-Identifier: Apache-2.0
// The data that CODESYS, TwinCAT and InduRoP store in extensions of the format, whose names are numbers or addresses.

#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "control/plc/network/diagram.h"

namespace indurop::plc::plcopen {

inline constexpr std::string_view kExtensionsOfCodesys = "http://www.3s-software.com/plcopenxml/";

// Extension of a variable: BOOL R_EDGE is "rising", BOOL F_EDGE is "falling". The format itself cannot express it.
inline constexpr std::string_view kEdgeExtension = "https://indurop.org/plcopenxml/edge";

// Extension of a variable: the arguments of FB_Init of the instance.
inline constexpr std::string_view kStartExtension = "http://www.3s-software.com/plcopenxml/inputassignments";

// Entry, main and exit action of a step.
inline constexpr std::array<std::pair<std::string_view, const char*>, 3> kStepActions{
    {{"a6b08bd8-b696-47e3-9cbf-7408b61c9ff8", "P1"},
     {"700a583f-b4d4-43e4-8c14-629c7cd3bec8", network::kWhileActive},
     {"a2621e18-7de3-4ea6-ae6d-89e9e0b7befd", "P0"}}};

[[nodiscard]] inline std::string guid_of(std::string_view qualifier) {
  for (const auto& [guid, known] : kStepActions) {
    if (qualifier == known) {
      return std::string(guid);
    }
  }
  return {};
}

}  // namespace indurop::plc::plcopen
