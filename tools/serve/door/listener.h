// SPDX-License-Identifier: Apache-2.0
// The socket the door listens on. Own code instead of the library's, because it has to be bound to exactly the
// requested address or to none.

#pragma once

#include <indurop/result.h>

#include <string>

#include "core/base/descriptor.h"
#include "core/base/problem.h"

namespace indurop::serve {

class Listener {
 public:
  // `address`: one of this machine, numeric or "localhost"; `port` 0: any free one.
  static Result<Listener, base::Problem> open(const std::string& address, int port);

  [[nodiscard]] int file() const noexcept { return file_.get(); }
  [[nodiscard]] int port() const noexcept { return port_; }
  struct Taken {
    base::Descriptor file;
    std::string address;
    bool loopback = false;
  };
  // Returns the next connection. Never blocks. Error: `sys_errno` is 0 if none waits, else why accepting failed.
  [[nodiscard]] Result<Taken, Error> take() const;

 private:
  Listener(base::Descriptor file, int port) noexcept : file_(std::move(file)), port_(port) {}

  base::Descriptor file_;
  int port_ = 0;
};

}  // namespace indurop::serve
