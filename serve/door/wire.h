// SPDX-License-Identifier: Apache-2.0
// Bytes from and to one client, through TLS if there is any. Nothing blocks.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/descriptor.h"
#include "serve/door/tls.h"

namespace indurop::serve {

class Wire {
 public:
  // `context` null: without TLS.
  Wire(base::Descriptor file, SSL_CTX* context);

  enum class State { Done, Later, Ended };
  // Appends what has come, at most some kilobytes. Ended: the client sends no more.
  State read(std::string& into);
  // `taken`: so many bytes of `bytes` are on their way. The rest has to be given again, from its first byte on.
  State write(std::string_view bytes, std::size_t& taken);
  // Tells the client that nothing more comes.
  void finish();

  [[nodiscard]] int file() const noexcept { return file_.get(); }
  // TLS waits for room to send, whatever is read or written.
  [[nodiscard]] bool waits_for_room() const noexcept { return waits_for_room_; }
  // Something was received already that poll() does not tell of.
  [[nodiscard]] bool holds_input() const;
  // The client's certificate as PEM, if it showed one that is valid; else empty.
  [[nodiscard]] std::string certificate() const;

 private:
  State after_tls(int result);

  base::Descriptor file_;
  TlsConnection tls_;
  bool waits_for_room_ = false;
  bool broken_ = false;
};

}  // namespace indurop::serve
