// SPDX-License-Identifier: Apache-2.0
// A Modbus device for the tests, good and bad as commanded on stdin:
//   modbus_server tcp|rtu      prints "at ADDRESS"
//   set coil|discrete|input|holding NUMBER VALUE
//   get coil|holding NUMBER    prints "coil 3 = 1"
//   serve | hang | garbage | trickle | refuse | stranger     how requests are answered; each prints its word when it is
//   in force leave | return             the address is closed, and opened again
#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <modbus/modbus.h>

namespace {

constexpr int kPlaces = 300;
constexpr int kTrickleMs = 20;

struct Free {
  void operator()(modbus_t* context) const { modbus_free(context); }
  void operator()(modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }
};
using Context = std::unique_ptr<modbus_t, Free>;

class Server {
 public:
  explicit Server(bool serial) : serial_(serial), places_(modbus_mapping_new(kPlaces, kPlaces, kPlaces, kPlaces)) {
    if (serial_) {
      open_terminal();
    } else {
      listen();
    }
  }

  int run() {
    while (true) {
      std::vector<pollfd> waiting{{STDIN_FILENO, POLLIN, 0}};
      if (listener_ >= 0) {
        waiting.push_back({listener_, POLLIN, 0});
      }
      for (const Context& client : clients_) {
        waiting.push_back({modbus_get_socket(client.get()), POLLIN, 0});
      }
      ::poll(waiting.data(), waiting.size(), -1);
      if ((waiting[0].revents & (POLLIN | POLLHUP)) != 0 && !read_commands()) {
        return 0;
      }
      // A command may have opened or closed the listener meanwhile.
      if (waiting.size() > 1 && waiting[1].fd == listener_ && (waiting[1].revents & POLLIN) != 0) {
        add_client(::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC));
      }
      serve_clients();
    }
  }

 private:
  void open_terminal() {
    terminal_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    ::grantpt(terminal_);
    ::unlockpt(terminal_);
    termios raw{};
    ::tcgetattr(terminal_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(terminal_, TCSANOW, &raw);
    const std::string path = ::ptsname(terminal_);
    keeper_ =
        ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);  // without a process at the other end reads would fail
    std::cout << "at " << path << std::endl;
    add_client(terminal_);
  }

  void listen() {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port_);
    auto* any = reinterpret_cast<sockaddr*>(&address);
    socklen_t size = sizeof address;
    if (::bind(listener_, any, size) != 0 || ::listen(listener_, 8) != 0 || ::getsockname(listener_, any, &size) != 0) {
      std::perror("modbus_server");
      std::exit(1);
    }
    port_ = ntohs(address.sin_port);
    std::cout << "at 127.0.0.1:" << port_ << std::endl;
  }

  void add_client(int fd) {
    if (fd < 0) {
      return;
    }
    Context client(serial_ ? modbus_new_rtu("/dev/null", 19200, 'E', 8, 1) : modbus_new_tcp("127.0.0.1", 0));
    modbus_set_slave(client.get(), 1);
    modbus_set_socket(client.get(), fd);
    clients_.push_back(std::move(client));
  }

  void drop(std::size_t i) {
    ::close(modbus_get_socket(clients_[i].get()));
    clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  void serve_clients() {
    for (std::size_t i = clients_.size(); i > 0; --i) {
      pollfd ready{modbus_get_socket(clients_[i - 1].get()), POLLIN, 0};
      if (::poll(&ready, 1, 0) > 0 && !answer(*clients_[i - 1]) && !serial_) {
        drop(i - 1);
      }
    }
  }

  bool answer(modbus_t& client) {
    std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> request{};
    const int length = modbus_receive(&client, request.data());
    if (length <= 0) {
      return length == 0;
    }
    const int fd = modbus_get_socket(&client);
    if (mode_ == "hang") {
      return true;
    }
    if (mode_ == "refuse") {
      return modbus_reply_exception(&client, request.data(), MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS) > 0;
    }
    if (mode_ == "garbage") {
      const std::string noise = "\x7F no Modbus at all, but long enough to be taken for some \xFF\x03";
      return ::write(fd, noise.data(), noise.size()) > 0;
    }
    if (mode_ == "stranger" && !serial_) {
      constexpr std::size_t kUnit = 6;
      ++request[kUnit];
    }
    if (mode_ == "trickle") {
      for (int i = 0; i < 8 && ::write(fd, request.data(), 1) == 1; ++i) {
        ::usleep(kTrickleMs * 1000);
      }
      return true;
    }
    return modbus_reply(&client, request.data(), length, places_.get()) > 0;
  }

  bool read_commands() {
    std::array<char, 1024> buffer{};
    const ssize_t size = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (size <= 0) {
      return false;
    }
    pending_.append(buffer.data(), static_cast<std::size_t>(size));
    for (std::size_t end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n')) {
      obey(pending_.substr(0, end));
      pending_.erase(0, end + 1);
    }
    return true;
  }

  void obey(const std::string& line) {
    std::istringstream words(line);
    std::string word;
    std::string table;
    std::size_t number = 0;
    int value = 0;
    words >> word >> table >> number >> value;
    if (word == "set" || word == "get") {
      std::uint8_t* bit = table == "coil" ? places_->tab_bits : table == "discrete" ? places_->tab_input_bits : nullptr;
      std::uint16_t* reg = table == "holding" ? places_->tab_registers : places_->tab_input_registers;
      if (word == "get") {
        std::cout << table << ' ' << number << " = " << (bit != nullptr ? bit[number] : reg[number]) << std::endl;
      } else if (bit != nullptr) {
        bit[number] = static_cast<std::uint8_t>(value);
      } else {
        reg[number] = static_cast<std::uint16_t>(value);
      }
      return;
    }
    if (word == "leave") {
      ::close(listener_);
      listener_ = -1;
      while (!clients_.empty()) {
        drop(clients_.size() - 1);
      }
    } else if (word == "return") {
      listen();
    } else {
      mode_ = word;
    }
    std::cout << word << std::endl;
  }

  bool serial_;
  std::unique_ptr<modbus_mapping_t, Free> places_;
  std::vector<Context> clients_;
  int listener_ = -1;
  int terminal_ = -1;
  int keeper_ = -1;
  std::uint16_t port_ = 0;
  std::string mode_ = "serve";
  std::string pending_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: modbus_server tcp|rtu\n";
    return 2;
  }
  std::signal(SIGPIPE, SIG_IGN);  // clients go away in the middle of an answer
  return Server(std::string(argv[1]) == "rtu").run();
}
