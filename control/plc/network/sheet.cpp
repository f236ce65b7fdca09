// SPDX-License-Identifier: Apache-2.0
#include "control/plc/network/sheet.h"

#include "control/plc/network/check.h"

namespace indurop::plc::network {

const char* word_of(Body::Language language) noexcept {
  return language == Body::Language::Ld ? "rung" : "network";
}

Sheet make_sheet(Body& body, const std::string& what, Diagnostics& diagnostics) {
  Sheet sheet{split_networks(body.diagram, what, word_of(body.language)), Index(body.diagram), {}};
  sheet.order = order_of(sheet.networks, sheet.index);
  check_networks(body.diagram, sheet.networks, sheet.index, sheet.order, body.language, diagnostics);
  return sheet;
}

}  // namespace indurop::plc::network
