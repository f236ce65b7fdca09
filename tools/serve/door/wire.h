// SPDX-License-Identifier: Apache-2.0
// Reads and writes the bytes of one client, optionally through TLS. Never blocks.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/descriptor.h"
#include "tools/serve/door/tls.h"

namespace indurop::serve {

class Wire {
 public:
  // `context` null: without TLS.
  Wire(base::Descriptor file, SSL_CTX* context);

  enum class State { Done, Later, Ended };
  // Appends received bytes, at most some kilobytes. Ended: the client sends no more.
  State read(std::string& into);
  // `taken` is the number of bytes that were accepted. The rest has to be passed again, from its first byte on.
  State write(std::string_view bytes, std::size_t& taken);
  // Signals the client that nothing more is sent.
  void finish();

  [[nodiscard]] int file() const noexcept { return file_.get(); }
  // Returns true if TLS waits until it can send, for reading as well as for writing.
  [[nodiscard]] bool waits_for_room() const noexcept { return waits_for_room_; }
  // Returns true if input is buffered that poll() does not report.
  [[nodiscard]] bool holds_input() const;
  // Returns the client's certificate as PEM if it presented a valid one; else an empty text.
  [[nodiscard]] std::string certificate() const;

 private:
  State after_tls(int result);

  base::Descriptor file_;
  TlsConnection tls_;
  bool waits_for_room_ = false;
  bool broken_ = false;
};

}  // namespace indurop::serve
