// SPDX-License-Identifier: Apache-2.0
// Charts that are actions: each has its own steps, which are the same wherever the action is run from.

#pragma once

#include <functional>
#include <map>
#include <string>

#include "plc/lower/lowered.h"
#include "plc/network/networks.h"

namespace indurop::plc::lower {

class InnerCharts {
 public:
  InnerCharts(const network::PouCode& code, ast::Pou& pou) : code_(&code), pou_(&pou) {}

  // Statements of the action at one more place that runs it. The first time `lower` makes them, and the POU gets the
  // variables that are kept.
  [[nodiscard]] Lowered use(const network::Body& body, const std::function<Lowered()>& lower);

 private:
  [[nodiscard]] bool is_taken(const std::string& name) const;

  const network::PouCode* code_;
  ast::Pou* pou_;
  std::map<const network::Body*, Lowered> known_;
  int uses_ = 0;
};

}  // namespace indurop::plc::lower
