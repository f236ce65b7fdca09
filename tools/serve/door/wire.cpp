// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/wire.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>

namespace indurop::serve {
namespace {

constexpr std::size_t kPiece = 16U << 10;

bool later(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

Wire::Wire(base::Descriptor file, SSL_CTX* context) : file_(std::move(file)) {
  if (context == nullptr) {
    return;
  }
  tls_.reset(SSL_new(context));
  broken_ = tls_ == nullptr || SSL_set_fd(tls_.get(), file_.get()) != 1;
  if (!broken_) {
    SSL_set_accept_state(tls_.get());
  }
}

Wire::State Wire::after_tls(int result) {
  const int error = SSL_get_error(tls_.get(), result);
  waits_for_room_ = error == SSL_ERROR_WANT_WRITE;
  if (error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE) {
    return State::Later;
  }
  broken_ = broken_ || error != SSL_ERROR_ZERO_RETURN;  // nothing can be sent any more
  return State::Ended;
}

Wire::State Wire::read(std::string& into) {
  if (broken_) {
    return State::Ended;
  }
  std::array<char, kPiece> buffer{};
  if (tls_ != nullptr) {
    std::size_t got = 0;
    ERR_clear_error();  // of a certificate or list that could not be read: SSL_get_error() would take it for its own
    const int result = SSL_read_ex(tls_.get(), buffer.data(), buffer.size(), &got);
    if (result != 1) {
      return after_tls(result);
    }
    waits_for_room_ = false;
    into.append(buffer.data(), got);
    return State::Done;
  }
  const ssize_t got = ::recv(file_.get(), buffer.data(), buffer.size(), 0);
  if (got <= 0) {
    return got < 0 && later(errno) ? State::Later : State::Ended;
  }
  into.append(buffer.data(), static_cast<std::size_t>(got));
  return State::Done;
}

Wire::State Wire::write(std::string_view bytes, std::size_t& taken) {
  taken = 0;
  if (broken_) {
    return State::Ended;
  }
  if (tls_ != nullptr) {
    ERR_clear_error();
    const int result = SSL_write_ex(tls_.get(), bytes.data(), bytes.size(), &taken);
    if (result != 1) {
      return after_tls(result);
    }
    waits_for_room_ = false;
    return State::Done;
  }
  const ssize_t sent = ::send(file_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (sent < 0) {
    broken_ = !later(errno);
    return broken_ ? State::Ended : State::Later;
  }
  taken = static_cast<std::size_t>(sent);
  return State::Done;
}

void Wire::finish() {
  if (tls_ != nullptr && !broken_) {
    (void)SSL_shutdown(tls_.get());
    ERR_clear_error();
  }
  ::shutdown(file_.get(), SHUT_WR);
}

bool Wire::holds_input() const {
  return tls_ != nullptr && !broken_ && SSL_pending(tls_.get()) > 0;
}

std::string Wire::certificate() const {
  if (tls_ == nullptr || SSL_get_verify_result(tls_.get()) != X509_V_OK) {
    return {};
  }
  const std::unique_ptr<X509, void (*)(X509*)> peer(SSL_get1_peer_certificate(tls_.get()), &X509_free);
  const std::unique_ptr<BIO, void (*)(BIO*)> out(BIO_new(BIO_s_mem()), &BIO_free_all);
  if (peer == nullptr || out == nullptr || PEM_write_bio_X509(out.get(), peer.get()) != 1) {
    return {};
  }
  const char* data = nullptr;
  const long size = BIO_ctrl(out.get(), BIO_CTRL_INFO, 0, static_cast<void*>(&data));
  return {data, static_cast<std::size_t>(std::max(size, 0L))};
}

}  // namespace indurop::serve
