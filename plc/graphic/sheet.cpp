// SPDX-License-Identifier: Apache-2.0
#include "plc/graphic/sheet.h"

#include <algorithm>

#include "plc/graphic/check.h"

namespace indurop::plc::graphic {

const char* word_of(Body::Language language) noexcept {
  return language == Body::Language::Ld ? "rung" : "network";
}

std::vector<Picture> lay_out(const Sheet& sheet, Body::Language language) {
  const bool ladder = language == Body::Language::Ld;
  int width = 0;
  std::vector<Picture> pictures;
  for (const Network& network : sheet.networks) {
    pictures.push_back(lay_out(network, sheet.index, sheet.order, ladder));
    width = std::max(width, pictures.back().width);
  }
  for (std::size_t i = 0; ladder && i < pictures.size(); ++i) {
    if (pictures[i].width < width) {
      pictures[i] = lay_out(sheet.networks[i], sheet.index, sheet.order, true, width);
    }
  }
  return pictures;
}

Sheet make_sheet(Body& body, const std::string& what, Diagnostics& diagnostics) {
  Sheet sheet{split_networks(body.diagram, what, word_of(body.language)), Index(body.diagram), {}};
  sheet.order = order_of(sheet.networks, sheet.index);
  check_networks(body.diagram, sheet.networks, sheet.index, sheet.order, body.language, diagnostics);
  return sheet;
}

}  // namespace indurop::plc::graphic
