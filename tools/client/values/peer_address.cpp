// SPDX-License-Identifier: Apache-2.0
#include "tools/client/values/peer_address.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <future>
#include <thread>
#include <utility>

#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct Answer {
  int code = 0;         // of getaddrinfo()
  std::string address;  // empty: it has no IPv4 address
};

Answer ask(const std::string& name) {
  Answer answer;
  addrinfo* found = nullptr;
  answer.code = ::getaddrinfo(name.c_str(), nullptr, nullptr, &found);
  if (answer.code != 0) {
    return answer;
  }
  for (const addrinfo* one = found; one != nullptr && answer.address.empty(); one = one->ai_next) {
    if (one->ai_family == AF_INET) {
      std::array<char, INET_ADDRSTRLEN> text{};
      ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(one->ai_addr)->sin_addr, text.data(), text.size());
      answer.address = text.data();
    }
  }
  ::freeaddrinfo(found);
  return answer;
}

// Uses a detached thread, because getaddrinfo() has no time-out.
std::future<Answer> begin_to_ask(const std::string& name) {
  std::packaged_task<Answer()> task([name] { return ask(name); });
  std::future<Answer> answer = task.get_future();
  std::thread(std::move(task)).detach();
  return answer;
}

// Returns false if the time is over, or the user interrupts.
bool wait_for(const std::future<Answer>& answer, rt::MonoTime deadline) {
  constexpr std::chrono::milliseconds kLook{20};
  while (answer.wait_for(kLook) != std::future_status::ready) {
    if (interrupted() || rt::MonoClock::now() >= deadline) {
      return false;
    }
  }
  return true;
}

// Returns the position of the colon before the port, or the end of the text.
std::size_t end_of_name(const std::string& peer) {
  const auto colon = peer.rfind(':');
  const bool port = colon != std::string::npos && peer.find(':') == colon;  // several colons: an IPv6 address
  return port ? colon : peer.size();
}

}  // namespace

Result<std::vector<std::string>, Failure> peer_addresses(const std::vector<std::string>& peers, rt::MonoTime deadline) {
  std::vector<std::future<Answer>> answers;
  answers.reserve(peers.size());
  for (const std::string& peer : peers) {
    answers.push_back(begin_to_ask(peer.substr(0, end_of_name(peer))));
  }
  std::vector<std::string> addresses;
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const auto fail = [&](int code, const char* why) {
      return Failure{code, fmt::format("--peer {}: {}", printable(peers[i]), why)};
    };
    if (!wait_for(answers[i], deadline)) {
      return interrupted()
                 ? Failure{interrupt_code(), {}}
                 : fail(kUnreachable, "no name server has answered yet; give its address, or wait longer with --wait");
    }
    const Answer answer = answers[i].get();
    if (answer.code != 0) {
      return fail(kUsage, ::gai_strerror(answer.code));
    }
    addresses.push_back(answer.address.empty() ? peers[i] : answer.address + peers[i].substr(end_of_name(peers[i])));
  }
  return addresses;
}

}  // namespace indurop::tools
