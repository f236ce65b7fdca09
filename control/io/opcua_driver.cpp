// SPDX-License-Identifier: Apache-2.0
#include "control/io/opcua_driver.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <nlohmann/json.hpp>

namespace indurop::io {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

constexpr std::size_t kMaxLine = std::size_t{4} * 1024 * 1024;
constexpr const char* kProgram = "indurop-opcua --client";

// Text, because JSON of JavaScript has no integers of 64 bits.
std::string text_of(Number value) {
  constexpr Number kIntegers = 18446744073709551616.0L;  // 2^64
  const bool is_whole = std::fabs(value) < kIntegers && std::trunc(value) == value;
  return is_whole ? fmt::format("{:.0f}", value) : fmt::format("{:.17g}", static_cast<double>(value));
}

std::optional<Number> number_of(const Json& value) {
  if (value.is_number_unsigned()) {
    return static_cast<Number>(value.get<std::uint64_t>());
  }
  if (value.is_number_integer()) {
    return static_cast<Number>(value.get<std::int64_t>());
  }
  if (value.is_number_float()) {
    return static_cast<Number>(value.get<double>());
  }
  if (value.is_null()) {
    return std::nan("");  // JSON has none
  }
  return std::nullopt;
}

std::optional<Quality> quality_of(const Json& value) {
  if (!value.is_number_unsigned()) {
    return std::nullopt;
  }
  const auto number = value.get<std::uint64_t>();
  for (const Quality each : {Quality::Good, Quality::Lost, Quality::Refused, Quality::OutOfRange, Quality::Reported}) {
    if (number == static_cast<std::uint64_t>(each)) {
      return each;
    }
  }
  return std::nullopt;
}

const Json* list_in(const Json& answer, const char* name, std::size_t size) {
  const auto found = answer.find(name);
  return found != answer.end() && found->is_array() && found->size() == size ? &*found : nullptr;
}

std::string text_in(const Json& answer, const char* name) {
  const auto found = answer.find(name);
  return found != answer.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::string OpcuaDriver::default_socket() {
  const char* const session = std::getenv("XDG_RUNTIME_DIR");  // NOLINT(concurrency-mt-unsafe): set before the start
  return session != nullptr && *session != '\0' ? std::string(session) + "/indurop-opcua.sock"
                                                : "/run/indurop/opcua.sock";
}

OpcuaDriver::OpcuaDriver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
                         std::span<const config::IoPoint> inputs)
    : device_(device), path_(device.opcua.socket.empty() ? default_socket() : device.opcua.socket) {
  for (const config::IoPoint& point : outputs) {
    outputs_.push_back(point.at);
  }
  for (const config::IoPoint& point : inputs) {
    inputs_.push_back(point.at);
  }
}

OpcuaDriver::~OpcuaDriver() {
  close();
}

void OpcuaDriver::close() noexcept {
  if (socket_ >= 0) {
    ::close(std::exchange(socket_, -1));
  }
  received_.clear();
}

std::string OpcuaDriver::description() const {
  return Json{{"device", device_.name},
              {"url", device_.address},
              {"security", config::name_of(device_.opcua.security)},
              {"user", device_.opcua.user},
              {"timeout_ms", device_.timeout / std::chrono::milliseconds(1)},
              {"outputs", outputs_},
              {"inputs", inputs_}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool OpcuaDriver::reach() {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path) {
    problem_ = fmt::format("the path of the socket {} is too long", path_);
    return false;
  }
  path_.copy(address.sun_path, path_.size());
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto* const to = reinterpret_cast<const sockaddr*>(&address);  // NOLINT: what the socket interface asks for
  if (socket_ < 0 || ::connect(socket_, to, sizeof address) != 0) {
    const int error = errno;
    problem_ = fmt::format("cannot reach {} at {}: {}; start it; trying again", kProgram, path_,
                           std::error_code(error, std::generic_category()).message());
    close();
    return false;
  }
  return send(description());
}

bool OpcuaDriver::open() {
  if (socket_ < 0 && !reach()) {
    close();
    return false;
  }
  const auto line = receive();
  if (!line) {
    problem_ = socket_ >= 0 ? fmt::format("waiting for a session with {}", device_.address) : problem_;
    return false;
  }
  const Json answer = Json::parse(*line, nullptr, false);
  if (answer.is_object() && answer.contains("ready")) {
    return true;
  }
  const std::string reason = answer.is_object() ? text_in(answer, "problem") : "";
  problem_ = reason.empty() ? fmt::format("{} sent something else than expected", kProgram) : reason;
  close();
  return false;
}

bool OpcuaDriver::send(const std::string& line) {
  const std::string bytes = line + "\n";
  const auto end = Clock::now() + device_.timeout;
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t now = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (now > 0) {
      sent += static_cast<std::size_t>(now);
      continue;
    }
    if (errno != EAGAIN && errno != EINTR) {
      problem_ = fmt::format("{} has ended; trying again", kProgram);
      return false;
    }
    pollfd ready{socket_, POLLOUT, 0};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0 || ::poll(&ready, 1, static_cast<int>(left.count())) == 0) {
      problem_ = fmt::format("{} does not read what it gets; trying again", kProgram);
      return false;
    }
  }
  return true;
}

std::optional<std::string> OpcuaDriver::receive() {
  const auto deadline = Clock::now() + device_.timeout;
  for (std::size_t searched = 0;;) {
    const std::size_t end = received_.find('\n', searched);
    if (end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    searched = received_.size();
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd ready{socket_, POLLIN, 0};
    if (left.count() <= 0 || ::poll(&ready, 1, static_cast<int>(left.count())) == 0) {
      return std::nullopt;
    }
    std::array<char, 16384> bytes;  // NOLINT: filled by recv
    const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (got > 0 && received_.size() < kMaxLine) {
      received_.append(bytes.data(), static_cast<std::size_t>(got));
    } else if (got >= 0 || (errno != EAGAIN && errno != EINTR)) {
      problem_ = fmt::format("{} has ended; trying again", kProgram);
      close();
      return std::nullopt;
    }
  }
}

std::string OpcuaDriver::request(std::span<const Sample> outputs) const {
  Json writes = Json::array();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].quality == Quality::Good) {
      writes.push_back({i, text_of(outputs[i].value)});
    }
  }
  return Json{{"write", std::move(writes)}}.dump();
}

Driver::Outcome OpcuaDriver::take(const std::string& line, std::span<Sample> outputs, std::span<Sample> inputs) {
  const Json answer = Json::parse(line, nullptr, false);
  const bool valid = answer.is_object();
  problem_ = valid ? text_in(answer, "problem") : "";
  const Json* const read = valid ? list_in(answer, "read", inputs.size()) : nullptr;
  const Json* const written = valid ? list_in(answer, "written", outputs.size()) : nullptr;
  if (read == nullptr || written == nullptr) {
    problem_ = problem_.empty() ? fmt::format("{} sent something else than expected", kProgram) : problem_;
    return Outcome::Lost;
  }
  bool good = true;
  const auto judge = [&good](Sample& sample, std::optional<Quality> quality) {
    sample.quality = quality.value_or(Quality::Lost);
    good = good && sample.quality == Quality::Good;
  };
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Json& pair = (*read)[i];
    const bool is_pair = pair.is_array() && pair.size() == 2;
    const auto value = is_pair ? number_of(pair[1]) : std::nullopt;
    judge(inputs[i], is_pair && value ? quality_of(pair[0]) : std::nullopt);
    inputs[i].value = inputs[i].quality == Quality::Good ? *value : inputs[i].value;
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].quality == Quality::Good) {
      judge(outputs[i], quality_of((*written)[i]));
    }
  }
  return good ? Outcome::Good : Outcome::Partly;
}

Driver::Outcome OpcuaDriver::exchange(std::span<Sample> outputs, std::span<Sample> inputs,
                                      std::chrono::nanoseconds /*elapsed*/) {
  if (!send(request(outputs))) {
    return Outcome::Lost;
  }
  if (const auto line = receive()) {
    return take(*line, outputs, inputs);
  }
  problem_ = socket_ >= 0 ? fmt::format("{} or {} does not answer in time; trying again", kProgram, device_.address)
                          : problem_;
  return Outcome::Lost;
}

}  // namespace indurop::io
