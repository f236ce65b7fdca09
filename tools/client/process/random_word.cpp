// SPDX-License-Identifier: Apache-2.0
#include "tools/client/process/random_word.h"

#include <sys/random.h>

#include <array>
#include <string_view>

namespace indurop::tools {

std::string random_word() {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::array<unsigned char, 32> bytes{};
  std::string word;
  if (getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size())) {
    for (const unsigned char byte : bytes) {
      word += kLetters[byte % kLetters.size()];
    }
  }
  return word;
}

}  // namespace indurop::tools
