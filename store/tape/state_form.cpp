// SPDX-License-Identifier: Apache-2.0
#include "store/tape/state_form.h"

#include <charconv>
#include <system_error>

namespace indurop::tape {

std::optional<FormLine> take_line(std::string_view& form) {
  const std::size_t name_end = form.find('\t');
  const std::size_t type_end = name_end == std::string_view::npos ? name_end : form.find('\t', name_end + 1);
  const std::size_t end = type_end == std::string_view::npos ? type_end : form.find('\n', type_end);
  if (end == std::string_view::npos) {
    return std::nullopt;
  }
  FormLine line{form.substr(0, name_end), form.substr(name_end + 1, type_end - name_end - 1), 0};
  const auto read = std::from_chars(form.data() + type_end + 1, form.data() + end, line.size);
  form.remove_prefix(end + 1);
  return read.ec == std::errc() && read.ptr == form.data() - 1 ? std::optional(line) : std::nullopt;
}

}  // namespace indurop::tape
