// SPDX-License-Identifier: Apache-2.0
// The files of the page, out of one folder and no other one.

#pragma once

#include <filesystem>
#include <string_view>

#include "serve/door/request.h"

namespace indurop::serve {

class Page {
 public:
  // `folder` empty: the one that was installed or built with this program.
  explicit Page(std::filesystem::path folder);

  [[nodiscard]] bool there() const;
  // The file of a path, "/" is index.html. If there is no page: for "/" what is missing.
  [[nodiscard]] Reply answer(std::string_view path) const;

 private:
  std::filesystem::path folder_;
};

// Is this path made of names that lead nowhere else?
bool harmless(std::string_view path) noexcept;
// "text/css; charset=utf-8" for "app.css".
std::string_view type_of(std::string_view path) noexcept;

}  // namespace indurop::serve
