// SPDX-License-Identifier: Apache-2.0
// Serves the files of the page, from one folder only.

#pragma once

#include <filesystem>
#include <string_view>

#include "tools/serve/door/request.h"

namespace indurop::serve {

class Page {
 public:
  // `folder` empty: the page that was installed or built with this program.
  explicit Page(std::filesystem::path folder);

  [[nodiscard]] bool there() const;
  // Returns the file of a path; "/" is index.html. Without a page "/" returns what is missing.
  [[nodiscard]] Reply answer(std::string_view path) const;

 private:
  std::filesystem::path folder_;
};

// Returns whether all parts of this path are plain names, so that it stays inside the folder.
bool harmless(std::string_view path) noexcept;
// Returns the content type: "text/css; charset=utf-8" for "app.css".
std::string_view type_of(std::string_view path) noexcept;

}  // namespace indurop::serve
