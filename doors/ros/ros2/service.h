// SPDX-License-Identifier: Apache-2.0
// A service as rmw_cyclonedds_cpp has it: a topic of requests and one of replies. Both begin with the number that the
// client has given, by which it finds its reply. Other middlewares of ROS 2 have the number elsewhere, and their
// clients do not have the mark of this one: what they send is not read. For one thread.

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <utility>

#include "doors/ros/ros2/participant.h"
#include "network/dds/entity.h"
#include "network/dds/guid.h"

namespace indurop::ros {

// Who has asked, and for the reply to what.
struct Caller {
  rmw_cyclonedds_dds__RequestHeader_ header{};
  dds::Guid participant{};
};

template <class Request, class Reply>
class Service {
 public:
  using Time = std::chrono::nanoseconds;  // monotonic
  // A client may be known by its request before its reader of replies is.
  static constexpr std::chrono::seconds kPatience{1};

  Result<void, base::Problem> open(Ros2Participant& participant, const std::string& name) {
    auto ends = participant.service<Request, Reply>(name);
    if (!ends) {
      return std::move(ends).error();
    }
    ends_ = std::move(*ends);
    return {};
  }

  // Calls `use(request, caller)` for what has arrived from clients of rmw_cyclonedds_cpp; requests are borrowed until
  // it returns.
  template <class Use>
  void take(Use use) {
    dds::take_all<Request>(ends_.requests.get(), [&](const Request& request, const dds::SampleInfo& info) {
      if (!info.valid) {
        return;
      }
      if (dds::mark_of(ends_.requests.get(), info.publication).find("clientid=") == std::string::npos) {
        ++strangers_;
        return;
      }
      if (const auto from = dds::participant_of(ends_.requests.get(), info.publication)) {
        use(request, Caller{request.request, *from});
      }
    });
  }

  // `fill` sets all of the reply but its number. What the reply borrows has to live as long as `fill`, which is called
  // as soon as the client can hear it, now or in step().
  void reply(const Caller& to, std::function<void(Reply&)> fill, Time now) {
    waiting_.push_back({to, std::move(fill), now + kPatience});
    step(now);
  }
  // Requests of other middlewares since the last call.
  std::uint64_t take_strangers() noexcept { return std::exchange(strangers_, 0); }
  // Sends what waits; a client that has not appeared in time gets no reply.
  void step(Time now) {
    waiting_.remove_if([&](const Waiting& one) { return send(one) || now > one.until; });
  }

 private:
  struct Waiting {
    Caller to;
    std::function<void(Reply&)> fill;
    Time until;
  };
  bool send(const Waiting& one) const {
    if (!dds::is_read_by(ends_.replies.get(), one.to.participant)) {
      return false;
    }
    Reply reply{};
    one.fill(reply);
    reply.request = one.to.header;
    return dds::write(ends_.replies.get(), reply).ok();
  }

  Ros2Participant::ServiceEnds ends_;
  std::list<Waiting> waiting_;
  std::uint64_t strangers_ = 0;
};

}  // namespace indurop::ros
