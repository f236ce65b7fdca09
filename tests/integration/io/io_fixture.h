// SPDX-License-Identifier: Apache-2.0
// Nodes with the I/O module in front of a program, and a Modbus server to talk to.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "node_fixture.h"

namespace indurop::test {

class IoTest : public NodeTest {
 protected:
  // A server of kind "tcp" or "rtu"; `address` is where it is.
  Program& serve(const std::string& kind, std::string& address) {
    programs_.push_back(
        std::make_unique<Program>(std::vector<std::string>{std::string(IO_FOLDER) + "/modbus_server", kind}));
    Program& server = *programs_.back();
    EXPECT_TRUE(server.prints("at "));
    EXPECT_TRUE(wait_until([&] { return server.out().find('\n') != std::string::npos; }));
    const std::string line = server.out();
    address = line.substr(3, line.find('\n') - 3);
    return server;
  }

  std::vector<Module> modules(const std::string& devices, const std::string& user = "io_user") {
    write("ioconfig.xml", "<ioconfig>\n" + devices + "\n</ioconfig>\n");
    return {
        {.file = IO_MODULE, .name = "io", .period = "5ms", .priority = 1, .properties = {{"config", "ioconfig.xml"}}},
        {.file = std::string(IO_FOLDER) + "/" + user + ".so", .name = user, .period = "5ms", .priority = 2}};
  }

  template <class T>
  bool becomes(const std::string& variable, T wanted) {
    const bool did = wait_until([&] { return value<T>(variable) == wanted; });
    EXPECT_TRUE(did) << variable << " is " << +value<T>(variable) << ", not " << +wanted;
    return did;
  }
};

// Asks the server until it says so.
inline bool has(Program& server, const std::string& place, int wanted) {
  const std::string answer = place + " = " + std::to_string(wanted) + "\n";
  const bool did = wait_until([&] {
    const std::size_t from = server.out().size();
    server.input("get " + place + "\n");
    return wait_until([&] { return server.out().find(" = ", from) != std::string::npos; }) &&
           server.out().find(answer, from) != std::string::npos;
  });
  EXPECT_TRUE(did) << "the server does not get " << answer;
  return did;
}

}  // namespace indurop::test
