// SPDX-License-Identifier: Apache-2.0
// From the networks of a ladder or function block diagram to statements. The power behind each contact, coil and
// enabled block becomes a BOOL of the scan (_p12 for element 12), what detects an edge a kept one (_e12).

#pragma once

#include <string>
#include <vector>

#include "plc/lower/lowered.h"
#include "plc/model/project.h"
#include "plc/network/sheet.h"

namespace indurop::plc::lower {

using network::Connection;
using network::Element;
using network::Network;
using network::Pin;
using network::Sheet;
using network::Source;
using network::Storage;

// Something a running view shows of a scan, valid at the end of its network and of the body.
struct FlowPoint {
  enum class Kind : std::uint8_t {
    Power,   // BOOL: flows out of the source; left out where it is derived_power()
    Closed,  // BOOL: the variable of a contact lets power through
    Value,   // of `type`: at an output of an instance
  };
  Kind kind = Kind::Power;
  Source source;
  ast::Expression value;
  Elementary type = Elementary::Bool;
  std::size_t behind = 0;  // its network ends behind so many statements of the body
  std::size_t number = 0;  // no Value: where it is told; those with the same value share a place
};

struct LoweredNetworks : Lowered {
  std::vector<FlowPoint> flow;          // in the order of execution
  std::vector<ast::Expression> wanted;  // values at the pins that were wanted
};

// A pin of something else that a value is drawn to.
struct WantedPin {
  const Element* element = nullptr;
  const Pin* pin = nullptr;
};

struct NetworkOptions {
  std::string prefix;                // of the names of variables; differs for each drawn body of a POU
  bool flow = false;                 // report it
  const Project* project = nullptr;  // whose functions and types the blocks may be
  std::vector<WantedPin> wanted;
};

[[nodiscard]] LoweredNetworks lower_networks(const Sheet& sheet, const NetworkOptions& options,
                                             Diagnostics& diagnostics);

}  // namespace indurop::plc::lower
