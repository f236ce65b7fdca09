// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/urdf_text.h"

#include <algorithm>

namespace indurop::robot {

std::size_t place_in_urdf(const std::string& text, const std::string& element, const std::string& name) {
  const std::string opening = "<" + element;
  for (const char* quote : {"\"", "'"}) {
    for (std::size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at + 1)) {
      const std::size_t end = text.find('>', at);
      const std::size_t found = text.find(std::string("name=") + quote + name + quote, at);
      if (found != std::string::npos && found < end) {
        return at;
      }
    }
  }
  return 0;
}

base::Diagnostic wrong_urdf(const std::string& file, const std::string& text, std::size_t offset,
                            const std::string& what) {
  offset = std::min(offset, text.size());
  const auto begin = text.begin();
  const auto line = std::count(begin, begin + static_cast<std::ptrdiff_t>(offset), '\n') + 1;
  const std::size_t start = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
  const std::size_t column = start == std::string::npos ? offset + 1 : offset - start;
  return {base::Diagnostic::Severity::Error, file, {static_cast<int>(line), static_cast<int>(column)}, what};
}

}  // namespace indurop::robot
