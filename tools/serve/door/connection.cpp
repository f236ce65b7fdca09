// SPDX-License-Identifier: Apache-2.0
// The part of a connection that handles HTTP.
#include "tools/serve/door/connection.h"

#include <poll.h>

#include <algorithm>
#include <utility>

namespace indurop::serve {
namespace {

constexpr std::int64_t kHeadNs = 10 * kSecondNs;  // for the whole head, including TLS
constexpr std::int64_t kIdleNs = 60 * kSecondNs;  // between two requests
constexpr std::int64_t kBodyNs = 8 * kSecondNs;
constexpr std::int64_t kAnswerNs = 3600 * kSecondNs;  // commands to a plant may take long
constexpr std::int64_t kSendNs = 30 * kSecondNs;      // without any progress
constexpr std::size_t kMostPieces = 64;               // read at once; then other connections are served

}  // namespace

Connection::Connection(Common& common, ConnectionLimits::Id id, Wire wire, std::string address)
    : common_(common), id_(id), wire_(std::move(wire)), address_(std::move(address)) {}

Connection::~Connection() {
  if (visitor_ != nullptr) {
    --common_.streams;
    common_.unknown_streams -= request_.client.role == Role::Unknown ? 1 : 0;
  }
  common_.limits.gone(id_);
}

short Connection::events() const {
  const bool asked = asked_ && phase_ == Phase::Stream;
  const bool sends = !output_.empty() || message_ != nullptr || wire_.waits_for_room() || asked;
  return static_cast<short>((input_ended_ ? 0 : POLLIN) | (sends ? POLLOUT : 0));
}

// A connection that waits for input in this phase may be ended in favour of others; one that is being answered or has a
// stream may not.
void Connection::enter(Phase phase, std::int64_t lasts_ns, std::int64_t now_ns) {
  phase_ = phase;
  deadline_ns_ = now_ns + lasts_ns;
  if (phase == Phase::Answering || phase == Phase::Body || phase == Phase::Stream) {
    common_.limits.busy(id_);
  } else {
    common_.limits.waiting(id_);
  }
}

void Connection::begin_at(std::int64_t now_ns) {
  enter(Phase::Head, kHeadNs, now_ns);
}

bool Connection::ready(short happened, std::int64_t now_ns) {
  if ((happened & (POLLHUP | POLLERR)) != 0 && input_ended_) {
    return false;
  }
  if (!input_ended_ && !receive(now_ns)) {
    return false;
  }
  return flush(now_ns);
}

bool Connection::receive(std::int64_t now_ns) {
  for (std::size_t i = 0; i < kMostPieces; ++i) {
    const Wire::State state = wire_.read(input_);
    if (state == Wire::State::Later) {
      return true;
    }
    if (state == Wire::State::Ended) {
      input_ended_ = true;
      return (phase_ == Phase::Answering || phase_ == Phase::Sending || phase_ == Phase::Held) && go_on(now_ns);
    }
    if (!go_on(now_ns)) {
      return false;
    }
  }
  return true;
}

// Processes the input received so far.
bool Connection::go_on(std::int64_t now_ns) {
  switch (phase_) {
    case Phase::Head:
      return requested(now_ns);
    case Phase::Body:
      return body_came(now_ns);
    case Phase::Stream:
      return read_frames(now_ns);
    case Phase::Closing:
      input_.clear();
      return true;
    case Phase::Answering:
    case Phase::Held:
    case Phase::Sending:
      if (close_) {
        input_.clear();
      }
      return input_.size() <= kMostHead;  // further requests, which have to wait
  }
  return false;
}

void Connection::read_certificate() {
  if (!std::exchange(certificate_read_, true)) {
    certificate_ = wire_.certificate();
  }
  // Checked for each request: it may have been revoked meanwhile.
  request_.certificate_pem = certificate_;
  request_.certificate = certificate_.empty() ? Client{} : common_.house->identify(certificate_);
}

bool Connection::requested(std::int64_t now_ns) {
  while (input_.starts_with("\r\n")) {
    input_.erase(0, 2);
  }
  const std::size_t length = head_length(input_);
  if (length == 0 && input_.size() <= kMostHead) {
    return true;
  }
  if (length == 0 || length > kMostHead) {
    return refuse(refusal(status::kHeadTooLarge, "the headers are too long"), now_ns);
  }
  auto head = read_head(std::string_view(input_).substr(0, length));
  input_.erase(0, length);
  if (!head) {
    return refuse(std::move(head).error(), now_ns);
  }
  request_ = request_of(*head);
  no_body_ = head->method == "HEAD";
  request_.from = address_;
  read_certificate();
  if (!head->field("upgrade").empty()) {
    return upgrade(*head, request_, now_ns);
  }
  const auto body = body_length(*head);
  body_length_ = body ? *body : 0;
  request_.has_body = body_length_ > 0;
  if (auto refused = common_.house->refuse(request_)) {
    return refuse(std::move(*refused), now_ns);
  }
  if (!body) {
    return refuse(body.error(), now_ns);
  }
  if (body_length_ == 0) {
    return answer(now_ns);
  }
  if (head->has_word("expect", "100-continue")) {
    output_ += "HTTP/1.1 100 Continue\r\n\r\n";
  }
  enter(Phase::Body, kBodyNs, now_ns);
  return body_came(now_ns);
}

bool Connection::body_came(std::int64_t now_ns) {
  if (input_.size() < body_length_) {
    return true;
  }
  request_.body = input_.substr(0, body_length_);
  input_.erase(0, body_length_);
  // The body may arrive seconds after the headers: the client may have lost a right meanwhile.
  read_certificate();
  if (auto refused = common_.house->refuse(request_)) {
    return refuse(std::move(*refused), now_ns);
  }
  return answer(now_ns);
}

bool Connection::answer(std::int64_t now_ns) {
  ticket_ = ++common_.last_ticket;
  enter(Phase::Answering, kAnswerNs, now_ns);
  auto reply = common_.house->answer(request_, ticket_);
  return !reply || begin(std::move(*reply), now_ns);
}

bool Connection::reply(Reply reply, std::int64_t now_ns) {
  const bool refused = !reply.wrong_credentials.empty();
  return (refused ? refuse(std::move(reply), now_ns) : begin(std::move(reply), now_ns)) && flush(now_ns);
}

bool Connection::refuse(Reply reply, std::int64_t now_ns) {
  reply.close = true;
  close_ = true;
  if (!reply.lacks_right.empty()) {
    if (const std::uint64_t count = common_.lacking_rights.count(now_ns); count > 0) {
      common_.house->note_refused(request_, reply.lacks_right, count);
    }
  }
  if (reply.wrong_credentials.empty()) {
    return begin(std::move(reply), now_ns);
  }
  const WrongTokens::Verdict verdict = common_.wrong_tokens.wrong(address_, now_ns);
  if (verdict.note > 0) {
    common_.house->note_refused(request_, reply.wrong_credentials, verdict.note);
  }
  if (verdict.delay_ns == 0) {
    return begin(std::move(reply), now_ns);
  }
  held_ = std::move(reply);
  enter(Phase::Held, verdict.delay_ns, now_ns);
  return true;
}

bool Connection::begin(Reply reply, std::int64_t now_ns) {
  reply.close = reply.close || request_.close || input_ended_;
  close_ = reply.close;
  output_ += head_of(reply) + (no_body_ ? std::string() : reply.body);
  enter(Phase::Sending, kSendNs, now_ns);
  return true;
}

bool Connection::flush(std::int64_t now_ns) {
  for (;;) {
    if (output_.empty() && message_ == nullptr && !next_message()) {
      return sent_all(now_ns);
    }
    // A frame that was begun is sent first: a control frame must not be inserted into it.
    const bool frame = message_ != nullptr && (message_sent_ > 0 || output_.empty());
    const std::string_view rest = frame ? rest_of_message() : std::string_view(output_).substr(sent_);
    std::size_t taken = 0;
    const Wire::State state = wire_.write(rest, taken);
    if (state == Wire::State::Ended) {
      return false;
    }
    if (state == Wire::State::Later) {
      return true;
    }
    std::size_t& progress = frame ? message_sent_ : sent_;
    progress += taken;
    if (phase_ == Phase::Sending && taken > 0) {
      deadline_ns_ = now_ns + kSendNs;
    }
    if (taken == rest.size()) {
      if (frame) {
        message_.reset();
        message_sent_ = 0;
      } else {
        output_.clear();
        sent_ = 0;
      }
    }
  }
}

bool Connection::sent_all(std::int64_t now_ns) {
  if (phase_ != Phase::Sending) {
    return true;
  }
  if (!close_) {
    enter(Phase::Head, input_.empty() ? kIdleNs : kHeadNs, now_ns);
    return input_.empty() || (requested(now_ns) && flush(now_ns));
  }
  if (input_ended_) {
    return false;
  }
  // The client closes first: closing while input arrives would discard the data that was just sent.
  wire_.finish();
  enter(Phase::Closing, kClosingNs, now_ns);
  input_.clear();
  return true;
}

bool Connection::on_time(std::int64_t now_ns) {
  switch (phase_) {
    case Phase::Head:
      if (input_.empty()) {
        return false;
      }
      return refuse(refusal(status::kTimeout, "the request did not come in time"), now_ns) && flush(now_ns);
    case Phase::Body:
      return refuse(refusal(status::kTimeout, "the body did not come in time"), now_ns) && flush(now_ns);
    case Phase::Held:
      return begin(std::exchange(held_, {}), now_ns) && flush(now_ns);
    case Phase::Stream:
      return stream_on_time(now_ns) && flush(now_ns);
    case Phase::Answering:
    case Phase::Sending:
    case Phase::Closing:
      return false;
  }
  return false;
}

}  // namespace indurop::serve
