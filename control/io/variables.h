// SPDX-License-Identifier: Apache-2.0
// Shared variables whose names are known only when the node starts. They are bound like those of a generated header,
// with one row each in the library's table, so an access costs the same as in a module. bind() and unbind() are not
// real-time safe, everything else is.

#pragma once

#include <indurop/detail/abi.h>

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::io {

class Variables {
 public:
  Variables() = default;
  Variables(const Variables&) = delete;
  Variables& operator=(const Variables&) = delete;
  ~Variables() { unbind(); }

  // Adds a number in a variable to read or to write. Call it before bind(). The part has at most 8 bytes.
  std::size_t add_read(const schema::Place& part);
  std::size_t add_write(const schema::Place& part);
  // Adds a text, which is read and written at once.
  std::size_t add_text(const schema::Place& part);
  void bind();
  void unbind();

  // Returns the part's bytes, in the format of scaling.h.
  [[nodiscard]] std::uint64_t read(std::size_t part) const noexcept;
  // The part's text, up to its first NUL.
  void read_text(std::size_t text, std::string& into) const;
  // Writes it if it differs; cuts it at the last character that fits, and returns false then.
  bool write_text(std::size_t text, std::string_view value);
  // Sets the value that commit() writes; a part that was never set is not written.
  void set(std::size_t part, std::uint64_t bits) noexcept;
  // Writes all parts that differ from the values of their variables, each variable in one commit.
  void commit() noexcept;

 private:
  struct Part {
    std::size_t row = 0;  // in rows_
    std::uint32_t offset = 0;
    std::uint32_t size = 0;
  };
  struct Write {
    Part part;
    std::uint64_t bits = 0;
    bool is_set = false;
  };
  Part part_of(const schema::Place& place);
  [[nodiscard]] std::uint64_t load(const Part& part) const noexcept;
  void commit_row(const std::vector<std::size_t>& writes) noexcept;
  [[nodiscard]] bool differs(const Write& write) const noexcept;

  std::deque<std::string> names_;
  std::vector<abi::Ref> rows_;
  std::vector<Part> reads_;
  std::vector<Write> writes_;
  std::vector<Part> texts_;
  std::vector<std::vector<std::size_t>> writes_of_row_;
  bool bound_ = false;
};

}  // namespace indurop::io
