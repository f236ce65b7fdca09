// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/ast.h"

namespace indurop::plc::ast {

std::string to_string(const DirectAddress& address) {
  if (address.numbers.empty()) {
    return {'%', address.area, '*'};
  }
  std::string text = {'%', address.area, address.size};
  for (std::size_t i = 0; i < address.numbers.size(); ++i) {
    text += (i > 0 ? "." : "") + std::to_string(address.numbers[i]);
  }
  return text;
}

}  // namespace indurop::plc::ast
