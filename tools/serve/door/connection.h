// SPDX-License-Identifier: Apache-2.0
// One client connection: its requests one after the other, or its WebSocket. It is called when input is available, when
// output is possible, and at its deadline; it never waits.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/base/note_limit.h"
#include "core/base/web_socket_frames.h"
#include "tools/serve/door/connection_limits.h"
#include "tools/serve/door/door.h"
#include "tools/serve/door/house.h"
#include "tools/serve/door/http_head.h"
#include "tools/serve/door/wire.h"
#include "tools/serve/door/wrong_tokens.h"

namespace indurop::serve {

inline constexpr std::int64_t kSecondNs = 1'000'000'000;
inline constexpr std::int64_t kClosingNs = 2 * kSecondNs;  // to end a connection properly

// Data that all connections share.
struct Common {
  DoorSettings settings;
  House* house = nullptr;
  ConnectionLimits limits;
  WrongTokens wrong_tokens;
  base::NoteLimit lacking_rights;
  Ticket last_ticket = 0;
  std::size_t streams = 0;
  std::size_t unknown_streams = 0;  // streams of clients without token or certificate
};

class Connection final : public Line {
 public:
  Connection(Common& common, ConnectionLimits::Id id, Wire wire, std::string address);
  ~Connection() override;

  [[nodiscard]] ConnectionLimits::Id id() const noexcept { return id_; }
  [[nodiscard]] int file() const noexcept { return wire_.file(); }
  [[nodiscard]] short events() const;  // the events to pass to poll()
  [[nodiscard]] std::int64_t deadline_ns() const noexcept { return deadline_ns_; }
  [[nodiscard]] bool holds_input() const { return !input_ended_ && wire_.holds_input(); }
  void begin_at(std::int64_t now_ns);
  // The following return false to end the connection.
  bool ready(short happened, std::int64_t now_ns);
  bool on_time(std::int64_t now_ns);
  bool reply(Reply reply, std::int64_t now_ns);
  // Returns whether it waits for this reply.
  [[nodiscard]] bool waits_for(Ticket ticket) const { return phase_ == Phase::Answering && ticket_ == ticket; }
  void ask() override { asked_ = true; }

 private:
  enum class Phase {
    Head,  // receiving the head of a request
    Body,
    Answering,  // the reply comes later
    Held,       // a refusal, which is delayed on purpose
    Sending,    // sending the reply
    Stream,     // a WebSocket
    Closing,    // all is sent, waits for the client to close
  };
  void enter(Phase phase, std::int64_t lasts_ns, std::int64_t now_ns);
  bool receive(std::int64_t now_ns);
  bool go_on(std::int64_t now_ns);
  bool requested(std::int64_t now_ns);
  bool body_came(std::int64_t now_ns);
  bool answer(std::int64_t now_ns);
  bool refuse(Reply reply, std::int64_t now_ns);
  bool begin(Reply reply, std::int64_t now_ns);
  bool flush(std::int64_t now_ns);
  bool sent_all(std::int64_t now_ns);
  bool upgrade(const Head& head, Request request, std::int64_t now_ns);
  bool open_stream(const std::string& accept, std::int64_t now_ns);
  bool read_frames(std::int64_t now_ns);
  int take_frame(base::FrameKind kind, const std::string& data);
  bool next_message();
  [[nodiscard]] std::string_view rest_of_message() const;
  bool close_stream(int code, std::int64_t now_ns);
  bool stream_on_time(std::int64_t now_ns);
  void read_certificate();

  Common& common_;
  ConnectionLimits::Id id_;
  Wire wire_;
  std::string address_;
  Phase phase_ = Phase::Head;
  std::int64_t deadline_ns_ = 0;
  std::string input_;
  bool input_ended_ = false;
  std::string output_;
  std::size_t sent_ = 0;  // bytes of it
  bool close_ = false;    // close after what is being sent
  bool no_body_ = false;  // HEAD: only the head of a reply is sent
  Request request_;
  std::size_t body_length_ = 0;
  Ticket ticket_ = 0;
  Reply held_;
  std::string certificate_;  // PEM
  bool certificate_read_ = false;

  // Members of a WebSocket.
  std::unique_ptr<Visitor> visitor_;
  base::FrameReader frames_{base::FrameSender::Client, kMostMessage};
  SharedMessage message_;
  std::size_t message_begin_ = 0;  // index in the frame
  std::size_t message_sent_ = 0;   // bytes of that
  bool asked_ = false;             // next() may have a message
  std::int64_t received_ns_ = 0;
};

}  // namespace indurop::serve
