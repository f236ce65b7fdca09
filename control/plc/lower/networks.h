// SPDX-License-Identifier: Apache-2.0
// Translates the networks of a ladder or function block diagram to statements. The power after each contact, coil and
// enabled block becomes a BOOL of the scan (_p12 for element 12); each edge detection has a retained one (_e12).

#pragma once

#include <string>
#include <vector>

#include "control/plc/lower/lowered.h"
#include "control/plc/model/project.h"
#include "control/plc/network/sheet.h"

namespace indurop::plc::lower {

using network::Connection;
using network::Element;
using network::Network;
using network::Pin;
using network::Sheet;
using network::Source;
using network::Storage;

// A point of a scan that a running view shows, valid at the end of its network and of the body.
struct FlowPoint {
  enum class Kind : std::uint8_t {
    Power,   // BOOL: flows out of the source; omitted if derived_power() has it
    Closed,  // BOOL: the variable of a contact lets power through
    Value,   // of `type`: at an output of an instance
  };
  Kind kind = Kind::Power;
  Source source;
  ast::Expression value;
  Elementary type = Elementary::Bool;
  std::size_t behind = 0;  // number of statements of the body at the end of its network
  std::size_t number = 0;  // not for Value: its index in the report; equal values share one
};

struct LoweredNetworks : Lowered {
  std::vector<FlowPoint> flow;          // in execution order
  std::vector<ast::Expression> wanted;  // values at the requested pins
};

// A pin of another element to which a value is drawn.
struct WantedPin {
  const Element* element = nullptr;
  const Pin* pin = nullptr;
};

struct NetworkOptions {
  std::string prefix;                // prefix of variable names; differs for each drawn body of a POU
  bool flow = false;                 // report the power flow
  const Project* project = nullptr;  // functions and types for the blocks
  std::vector<WantedPin> wanted;
};

[[nodiscard]] LoweredNetworks lower_networks(const Sheet& sheet, const NetworkOptions& options,
                                             Diagnostics& diagnostics);

}  // namespace indurop::plc::lower
