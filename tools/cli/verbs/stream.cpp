// SPDX-License-Identifier: Apache-2.0
// indurop stream: values for programs that draw them: as datagrams of JSON for PlotJuggler's UDP server, or for
// Foxglove, which indurop-serve serves.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <memory>
#include <utility>

#include "core/rt/clock.h"
#include "tools/cli/command/become_server.h"
#include "tools/cli/command/rounds.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/gentle.h"
#include "tools/client/values/watch_source.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kMostBytes = 60'000;  // maximum of a datagram; UDP has room for 65507

struct StreamOptions {
  std::vector<std::string> names;
  bool plotjuggler = false;
  bool foxglove = false;
  std::uint64_t port = 8765;
  std::string to = "127.0.0.1:9870";
  double hz = 50;
  std::uint64_t count = 0;
  std::int64_t timeout_ns = 0;
};

// Sends datagrams to one address.
class Sender {
 public:
  explicit Sender(int socket) : socket_(socket) {}
  Sender(Sender&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  Sender& operator=(Sender&&) = delete;
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;
  ~Sender() {
    if (socket_ >= 0) {
      ::close(socket_);
    }
  }

  // `to`: "host:9870", "[::1]:9870".
  static Result<Sender, Failure> open(const std::string& to) {
    const std::size_t colon = to.rfind(':');
    if (colon == std::string::npos || colon == 0) {
      return Failure{kUsage, fmt::format("'{}' is no address; write HOST:PORT, 127.0.0.1:9870", to)};
    }
    std::string host = to.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
      host = host.substr(1, host.size() - 2);
    }
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    if (const int code = ::getaddrinfo(host.c_str(), to.c_str() + colon + 1, &hints, &found); code != 0) {
      return Failure{kFailed, fmt::format("cannot send to '{}': {}", to, ::gai_strerror(code))};
    }
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> list(found, &::freeaddrinfo);
    Sender sender(::socket(list->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    if (sender.socket_ < 0 || ::connect(sender.socket_, list->ai_addr, list->ai_addrlen) != 0) {
      return Failure{kFailed, fmt::format("cannot send to '{}': {}", to, std::strerror(errno))};
    }
    return sender;
  }

  // A missing receiver is no failure: one may start later.
  void send(const std::string& text) const { (void)::send(socket_, text.data(), text.size(), MSG_NOSIGNAL); }

 private:
  int socket_;
};

// Returns the object for "knu::Robot::tick" in `root`: its namespaces are nested objects.
JsonValue& place_of(JsonValue& root, const std::string& name) {
  JsonValue* at = &root;
  std::size_t begin = 0;
  for (std::size_t end = name.find("::"); end != std::string::npos; end = name.find("::", begin)) {
    at = &(*at)[name.substr(begin, end - begin)];
    begin = end + 2;
  }
  return (*at)[name.substr(begin)];
}

class Stream {
 public:
  Stream(Context& context, Sender sender) : context_(context), sender_(std::move(sender)) {}

  // Sends all values, in as many datagrams as needed.
  void send(const WatchSource& source) {
    JsonValue message = begin();
    std::size_t bytes = 0;
    for (const WatchedValue& value : source.values()) {
      if (value.gone) {
        continue;
      }
      JsonValue raw = raw_value(value.item.place.type, value.bytes);
      const std::size_t size = raw.dump().size() + value.item.name.size() + 8;
      if (size > kMostBytes) {
        too_large(value.item.name);
        continue;
      }
      if (bytes + size > kMostBytes) {
        sender_.send(message.dump());
        message = begin();
        bytes = 0;
      }
      place_of(message, value.item.name) = std::move(raw);
      bytes += size;
    }
    sender_.send(message.dump());
  }

 private:
  JsonValue begin() const {
    JsonValue message = JsonValue::object();
    message["timestamp"] = static_cast<double>(rt::wall_ns()) / 1e9;
    return message;
  }
  void too_large(const std::string& name) {
    if (!reported_) {
      context_.out.error(fmt::format("{} does not fit into a datagram and is left out; name parts of it", name));
      reported_ = true;
    }
  }

  Context& context_;
  Sender sender_;
  bool reported_ = false;
};

// Origins of Foxglove's own pages and programs; only they may connect, and programs that are not browsers.
constexpr const char* kOrigins[] = {"https://app.foxglove.dev", "https://studio.foxglove.dev", "file://"};

int stream_to_foxglove(Context& context, const StreamOptions& options) {
  if (context.remote.wanted) {
    context.out.error("Foxglove gets the variables of this host only; run this on the board, or use --plotjuggler");
    return kUsage;
  }
  if (options.hz > kMostFoxgloveHz) {
    context.out.error(fmt::format("Foxglove gets at most {:g} messages per second and variable", kMostFoxgloveHz));
    return kUsage;
  }
  auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  ServeOptions serve;
  serve.node = std::move(node).value();
  serve.port = options.port;
  serve.foxglove = options.names;
  serve.foxglove_hz = options.hz;
  serve.origins.assign(std::begin(kOrigins), std::end(kOrigins));
  if (options.port != 0) {  // else the server prints the port
    context.out.note(fmt::format("in Foxglove: Open connection, Foxglove WebSocket, ws://localhost:{}", options.port));
  }
  return become_server(context, serve);
}

int stream(Context& context, const StreamOptions& options) {
  if (options.foxglove) {
    return stream_to_foxglove(context, options);
  }
  if (!options.plotjuggler) {
    context.out.error("name a receiver: --plotjuggler or --foxglove (see: indurop help stream)");
    return kUsage;
  }
  auto sender = Sender::open(options.to);
  if (!sender) {
    return report(context.out, sender.error());
  }
  WatchSource source(context.node, options.names);
  if (const auto opened = source.open(context); !opened) {
    return report(context.out, opened.error());
  }
  if (context.values->here()) {
    be_gentle(source.node());
  }
  context.out.note(fmt::format("{} values to {}, {:g} times a second", source.values().size(), options.to, options.hz));
  Stream out(context, std::move(sender).value());
  Rounds rounds(options.hz, options.count, options.timeout_ns);
  for (bool key = false; rounds.wait(-1, key); rounds.done()) {
    source.sample(context, 0, SIZE_MAX);
    if (source.alive()) {
      out.send(source);
    }
  }
  return interrupted() ? interrupt_code() : kOk;
}

Action declare_stream(base::Options& app, Context& context) {
  auto options = std::make_shared<StreamOptions>();
  constexpr double kMostHz = 1000;
  constexpr double kLeastHz = 0.001;
  constexpr double kMostPort = 65535;
  app.add("names", "GLOB", options->names, "Variables, parts of them, or globs")
      .required()
      .completes(base::Completion::Variable);
  app.flag("--plotjuggler", options->plotjuggler, "Send JSON over UDP to PlotJuggler's UDP server");
  app.flag("--foxglove", options->foxglove, "Wait for Foxglove to connect by WebSocket");
  app.add("--to", "HOST:PORT", options->to, "Address of PlotJuggler (default 127.0.0.1:9870)");
  app.add("--port", "PORT", options->port, "Port on which to wait for Foxglove (default 8765)").range(0, kMostPort);
  app.add("--hz", "RATE", options->hz, "Rounds per second (default 50, at most 1000; Foxglove 100)")
      .range(kLeastHz, kMostHz);
  app.add("-n,--count", "COUNT", options->count, "To PlotJuggler: stop after COUNT rounds");
  add_time_option(app, "--timeout", options->timeout_ns, "To PlotJuggler: stop after this time");
  add_node_option(app, context);
  add_remote_options(app, context);
  return [options](Context& c) { return stream(c, *options); };
}

}  // namespace

const Verb kStreamVerb{
    "stream", "Variables", "Send values to a program that plots them",
    "In PlotJuggler, start the UDP server with JSON, and let it use the field 'timestamp' (seconds since 1970).\n"
    "Namespaces are objects, so 'knu::Robot::tick' is shown as /knu/Robot/tick.\n"
    "In Foxglove, choose 'Open connection', 'Foxglove WebSocket', ws://localhost:8765. Each variable is a topic.\n"
    "The server can be reached only from this machine; from others use 'ssh -L 8765:localhost:8765 BOARD'.\n"
    "To see what happens in every tick, use indurop scope and indurop record.\n"
    "Examples:\n"
    "  indurop stream 'knu::Robot::*' --plotjuggler\n"
    "  indurop stream joints --plotjuggler --to 192.168.1.5:9870 --hz 100\n"
    "  indurop stream 'knu::Robot::*' --foxglove\n",
    &declare_stream};

}  // namespace indurop::tools
