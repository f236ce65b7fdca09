// SPDX-License-Identifier: Apache-2.0
#include "node/simulate/board_channel.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <tuple>

namespace indurop::node {
namespace {

using mirror::ByteReader;
using mirror::ByteWriter;
using mirror::Message;

constexpr suseconds_t kMomentUs = 20'000;
constexpr std::size_t kAtOnce = std::size_t{64} * 1024;

// The numbers of each message, in the order in which they are sent.
template <class Order>
auto numbers_of_order(Order& order) {
  return std::tie(order.end, order.signal, order.until_ns);
}
template <class Answer>
auto numbers_of_answer(Answer& answer) {
  return std::tie(answer.now_ns, answer.next_ns, answer.epoch_ns, answer.basic_period_ns, answer.took_ns, answer.ended);
}

void put_messages(ByteWriter& out, const std::vector<Message>& messages) {
  out.put(static_cast<std::uint32_t>(messages.size()));
  for (const Message& message : messages) {
    out.put_message(message);
  }
}

std::vector<Message> get_messages(ByteReader& in) {
  std::vector<Message> messages;
  const auto count = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    messages.push_back(in.get_message());
  }
  return messages;
}

}  // namespace

BoardChannel::BoardChannel(int socket) noexcept : socket_(socket) {
  const timeval moment{0, kMomentUs};
  (void)::fcntl(socket_, F_SETFD, FD_CLOEXEC);
  (void)::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &moment, sizeof moment);
}

BoardChannel::BoardChannel(BoardChannel&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), received_(std::move(other.received_)), word_(std::move(other.word_)) {}

BoardChannel& BoardChannel::operator=(BoardChannel&& other) noexcept {
  std::swap(socket_, other.socket_);
  std::swap(received_, other.received_);
  std::swap(word_, other.word_);
  return *this;
}

BoardChannel::~BoardChannel() {
  if (socket_ >= 0) {
    ::close(socket_);
  }
}

bool BoardChannel::send(const std::vector<std::uint8_t>& body) {
  ByteWriter word;
  word.put_bytes(body);  // its size first
  const std::vector<std::uint8_t> all = word.take();
  for (std::size_t at = 0; at < all.size();) {
    const ssize_t count = ::send(socket_, all.data() + at, all.size() - at, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) {
      return false;
    }
    at += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return true;
}

// Returns Got::Word when word_ holds a complete message.
BoardChannel::Got BoardChannel::receive() {
  for (;;) {
    std::uint32_t size = 0;
    if (received_.size() >= sizeof size) {
      std::memcpy(&size, received_.data(), sizeof size);
      if (received_.size() - sizeof size >= size) {
        const auto begin = received_.begin() + sizeof size;
        word_.assign(begin, begin + size);
        received_.erase(received_.begin(), begin + size);
        return Got::Word;
      }
    }
    buffer_.resize(kAtOnce);
    const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) {
      return Got::Nothing;
    }
    if (count <= 0) {
      return Got::End;
    }
    received_.insert(received_.end(), buffer_.begin(), buffer_.begin() + count);
  }
}

bool BoardChannel::send(const BoardPlace& place) {
  ByteWriter out;
  out.put(place.begin_ns);
  out.put(place.own);
  out.put(static_cast<std::uint32_t>(place.boards.size()));
  for (const std::string& board : place.boards) {
    out.put_text(board);
  }
  return send(out.take());
}

BoardChannel::Got BoardChannel::receive(BoardPlace& place) {
  const Got got = receive();
  if (got == Got::Word) {
    ByteReader in(word_);
    place.begin_ns = in.get<std::int64_t>();
    place.own = in.get<std::uint32_t>();
    const auto count = in.get<std::uint32_t>();
    place.boards.clear();
    for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
      place.boards.push_back(in.get_text());
    }
  }
  return got;
}

bool BoardChannel::send(const BoardOrder& order) {
  ByteWriter out;
  out.put_all(numbers_of_order(order));
  put_messages(out, order.arrivals);
  return send(out.take());
}

BoardChannel::Got BoardChannel::receive(BoardOrder& order) {
  const Got got = receive();
  if (got == Got::Word) {
    ByteReader in(word_);
    in.get_all(numbers_of_order(order));
    order.arrivals = get_messages(in);
  }
  return got;
}

bool BoardChannel::send(const BoardAnswer& answer) {
  ByteWriter out;
  out.put_all(numbers_of_answer(answer));
  put_messages(out, answer.sent);
  return send(out.take());
}

BoardChannel::Got BoardChannel::receive(BoardAnswer& answer) {
  const Got got = receive();
  if (got == Got::Word) {
    ByteReader in(word_);
    in.get_all(numbers_of_answer(answer));
    answer.sent = get_messages(in);
  }
  return got;
}

}  // namespace indurop::node
