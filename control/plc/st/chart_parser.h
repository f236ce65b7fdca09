// SPDX-License-Identifier: Apache-2.0
// Parses bodies of a text that are not Structured Text: sequential function charts in the standard's textual form
// (INITIAL_STEP, TRANSITION FROM a TO b) and instruction lists. They become the same data as those of a drawn file.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/network/diagram.h"
#include "control/plc/st/token_reader.h"

namespace indurop::plc::st {

// The code of the `pou`-th POU of the project, to be translated when all POUs are known.
struct WrittenBody {
  std::size_t pou = 0;
  std::optional<std::size_t> method = std::nullopt;  // of that POU
  network::PouCode code;
};

class ChartParser {
 public:
  explicit ChartParser(TokenReader& in) : in_(in) {}

  [[nodiscard]] bool at_chart() const;
  [[nodiscard]] bool at_instruction_list() const;

  // Parses up to `end`, which is not consumed. After errors returns the parts that were understood.
  [[nodiscard]] WrittenBody chart(std::string_view end);
  [[nodiscard]] WrittenBody instruction_list(std::string_view end);
  [[nodiscard]] WrittenBody statements(std::string_view end);
  // Parses the ACTIONs at this place, for this body.
  void actions(WrittenBody& to);

 private:
  using Element = network::Element;
  // TRANSITION FROM a, b TO c, stored until all steps are known.
  struct Transition {
    Place at;
    std::vector<const Token*> from;
    std::vector<const Token*> to;
    int priority = 0;
    std::shared_ptr<network::Body> condition;
  };

  bool step(bool initial);
  bool action_line(Element& block);
  bool action();
  bool transition();
  bool steps(std::vector<const Token*>& into);
  void take_action();
  [[nodiscard]] network::Body code_until(std::string_view end, network::Body::Language language,
                                         std::string_view other = {});
  void connect(const Transition& transition);
  [[nodiscard]] Element* step_named(const Token& name);
  Element& add(Element::Kind kind, const Place& at);
  static void lead(Element& to, std::uint64_t from);

  TokenReader& in_;
  WrittenBody out_;
  std::map<std::string, std::size_t> steps_;  // index of the element by name in capitals
  std::vector<Transition> transitions_;
};

}  // namespace indurop::plc::st
