// SPDX-License-Identifier: Apache-2.0
// Where messages go: a connection to a broker, in tests a list.

#pragma once

#include <string>
#include <string_view>

namespace indurop::mqtt {

enum class Retain : bool { No, Yes };

class Outlet {
 public:
  Outlet() = default;
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;
  virtual ~Outlet() = default;
  // Sends a message with quality of service 0, after those before. Returns false if there is no connection.
  virtual bool publish(const std::string& topic, std::string_view payload, Retain retain) = 0;
  virtual void subscribe(const std::string& filter) = 0;
  // Asks the broker to confirm that it has received everything before; returns the number of the confirmation, 0: there
  // is no connection.
  virtual int request_receipt() = 0;
  // Ends the connection after what was published; it is made again on its own.
  virtual void reconnect() = 0;
};

}  // namespace indurop::mqtt
