// SPDX-License-Identifier: Apache-2.0
// Charts that are actions: each has its own steps, shared by all places that run the action.

#pragma once

#include <functional>
#include <map>
#include <string>

#include "control/plc/lower/lowered.h"
#include "control/plc/network/networks.h"

namespace indurop::plc::lower {

class InnerCharts {
 public:
  InnerCharts(const network::PouCode& code, ast::Pou& pou) : code_(&code), pou_(&pou) {}

  // Returns the statements of the action for one more place that runs it. The first time `lower` makes them, and its
  // retained variables are added to the POU.
  [[nodiscard]] Lowered use(const network::Body& body, const std::function<Lowered()>& lower);

 private:
  [[nodiscard]] bool is_taken(const std::string& name) const;

  const network::PouCode* code_;
  ast::Pou* pou_;
  std::map<const network::Body*, Lowered> known_;
  int uses_ = 0;
};

}  // namespace indurop::plc::lower
