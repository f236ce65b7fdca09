// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/source_place.h"

namespace indurop::plc {

std::string to_string(const Place& place) {
  std::string text = place.file ? *place.file : std::string();
  if (place.line > 0) {
    text += ":" + std::to_string(place.line);
    if (place.column > 0) {
      text += ":" + std::to_string(place.column);
    }
  }
  return text;
}

}  // namespace indurop::plc
