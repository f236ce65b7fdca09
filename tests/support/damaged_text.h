// SPDX-License-Identifier: Apache-2.0
// Texts as they arrive after a fault or an attack.

#pragma once

#include <random>
#include <string>

namespace indurop::test {

// Returns the text with its end cut off, with another bit somewhere, or with another byte more.
inline std::string damaged(std::string text, std::mt19937& random) {
  const std::size_t at = random() % text.size();
  switch (random() % 3) {
    case 0:
      text.resize(at);
      break;
    case 1:
      text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1U << (random() % 8)));
      break;
    default:
      text.insert(at, 1, static_cast<char>(random() % 256));
  }
  return text;
}

}  // namespace indurop::test
