// SPDX-License-Identifier: Apache-2.0
// The code of a program combined with the data of a running one: which reported value is the power of which element.

#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "control/plc/draw/picture.h"
#include "control/plc/lower/networks.h"
#include "control/plc/network/chart.h"
#include "control/plc/plcopen/document.h"

namespace indurop::plc {

// The code of a program or function block, or of one of its actions.
struct LiveBody {
  std::string pou;
  std::string action;  // empty: the POU's own code
  network::Body* body = nullptr;

  // LD, FBD
  std::optional<network::Sheet> sheet;
  std::vector<draw::Picture> pictures;  // of the networks
  std::string flow_variable;            // of the POU, an array of BOOL; empty: no power flow
  using Key = std::pair<const network::Element*, const network::Pin*>;
  std::map<Key, std::size_t> power;  // index in that array; not for elements of derived_power()
  std::map<const network::Element*, std::size_t> closed;

  // SFC
  std::optional<network::Chart> chart;

  [[nodiscard]] bool drawn() const noexcept { return sheet.has_value() && !chart.has_value(); }
};

// The power in a drawn body: values reported by its module, and power derived from them.
class LivePower {
 public:
  using Power = std::function<bool(std::size_t)>;
  using Value = std::function<std::string(const std::string&)>;
  // `power`: returns an element of the array of `body`, which must outlive this object. `value`: returns the value of a
  // variable, by its name in capitals, as ST writes it; "" if it is not known. In function block diagrams wires from
  // variables and logic functions have the power that follows from the values at the end of the scan.
  LivePower(const LiveBody& body, Power power, Value value)
      : body_(body), power_(std::move(power)), value_(std::move(value)) {}

  // Returns whether there is power after the source.
  [[nodiscard]] bool powered(const network::Source& source);
  // Returns for a contact whether it lets power through, for other elements whether they have power.
  [[nodiscard]] bool closed(const network::Element& element);

 private:
  // Returns none if the value is not a BOOL, or not known.
  [[nodiscard]] std::optional<bool> known(const network::Source& source);
  [[nodiscard]] std::optional<bool> derived(const network::Source& source);
  [[nodiscard]] std::optional<bool> before(const network::Pin& pin);
  [[nodiscard]] std::optional<bool> of_variable(const std::string& text) const;
  [[nodiscard]] std::optional<bool> of_logic(const network::Element& element);

  const LiveBody& body_;
  Power power_;
  Value value_;
  std::unordered_map<const network::Element*, std::optional<bool>> derived_;
};

// Returns the bodies of all programs and function blocks, or of the named one, in the order of the document, to which
// they refer. A module built with ReadOptions::watch has the variables named here.
[[nodiscard]] std::vector<LiveBody> live_bodies(plcopen::Document& document, const std::string& pou,
                                                Diagnostics& diagnostics);

}  // namespace indurop::plc
