// SPDX-License-Identifier: Apache-2.0
// Programs drawn in a document, with what a running one of them tells: which shared variables, which bit is whose
// power.

#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plc/draw/picture.h"
#include "plc/draw/text_picture.h"
#include "plc/lower/networks.h"
#include "plc/plcopen/document.h"

namespace indurop::plc {

// A variable with an output of an instance.
struct LiveValue {
  network::Source source;
  std::string variable;
  Elementary type = Elementary::Int;
};

struct LiveProgram {
  std::string pou;
  std::string heading;
  network::Body::Language language = network::Body::Language::Ld;
  network::Sheet sheet;
  std::vector<draw::Picture> pictures;  // of the networks
  std::string flow_variable;            // bytes; empty: nothing in the program flows
  std::size_t flow_bytes = 0;
  std::vector<LiveValue> values;

  using Key = std::pair<const network::Element*, const network::Pin*>;
  std::map<Key, std::size_t> power;  // bits
  std::map<const network::Element*, std::size_t> closed;
};

// Programs in LD and FBD, all of them or the one named so. Refers to the document. Built with ReadOptions::watch a
// module has the variables named here.
[[nodiscard]] std::vector<LiveProgram> live_programs(plcopen::Document& document, const std::string& pou,
                                                     Diagnostics& diagnostics);

}  // namespace indurop::plc
