// SPDX-License-Identifier: Apache-2.0
// A drawn body as data: elements with ids, places on the sheet and connections, as the file says them and not yet
// checked. Ladder, function block diagram and sequential function chart have one form, because charts hold pieces of
// the others.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plc/model/ast.h"
#include "plc/model/place.h"

namespace indurop::plc::network {

enum class Storage : std::uint8_t { None, Set, Reset };

// On the sheet, or from the corner of an element.
struct Point {
  int x = 0;
  int y = 0;
};

// From the output `pin` of element `from`; "" is its only one.
struct Connection {
  Place at;
  std::uint64_t from = 0;
  std::string pin;
  std::vector<Point> corners;  // of its line, from here to there; none: the file has none
};

struct Pin {
  Place at;
  std::string name;  // of blocks: the formal parameter
  bool negated = false;
  ast::Edge edge = ast::Edge::None;
  Storage storage = Storage::None;
  std::vector<Connection> connections;  // of inputs
  std::optional<Point> spot;            // where it is at its element
  std::string expression;               // written at the pin instead of a connection: an operand, or the target
};

struct Body;

// The qualifier of what CODESYS runs in each scan in which a step is active; unlike N not once more after it.
inline constexpr const char* kWhileActive = "active";

// One line of an action block.
struct ActionLine {
  Place at;
  std::string qualifier = "N";
  std::string duration;
  std::string indicator;     // says nothing about the run
  std::string name;          // an action or a variable; empty: the body below
  bool only_action = false;  // never a variable
  std::shared_ptr<Body> inlined;
};

struct Element {
  enum class Kind : std::uint8_t {
    LeftRail,
    RightRail,
    Contact,
    Coil,
    Block,
    InVariable,
    OutVariable,
    InOutVariable,
    Label,
    Jump,
    Return,
    Connector,
    Continuation,
    Comment,
    Title,  // of a network, as some editors write it
    Step,
    Transition,
    JumpStep,
    SelectionDivergence,
    SelectionConvergence,
    SimultaneousDivergence,
    SimultaneousConvergence,
    ActionBlock,
  };
  Kind kind = Kind::Contact;
  std::uint64_t id = 0;
  Place at;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::string text;      // variable, expression, label, name of step or connector, comment, name of a condition
  std::string type;      // Block
  std::string instance;  // Block; empty: a function
  int order = 0;         // of execution; 0: not given
  bool negated = false;
  ast::Edge edge = ast::Edge::None;
  Storage storage = Storage::None;
  bool initial = false;             // Step
  int priority = 0;                 // Transition
  std::shared_ptr<Body> inlined;    // Transition: its condition as code; Block: what the box does, as code
  std::optional<Pin> condition;     // Transition: its condition as a connection
  std::vector<Pin> inputs;          // of others than blocks at most one
  std::vector<Point> ends;          // of others than blocks: where lines leave it
  std::vector<Pin> in_outs;         // Block
  std::vector<Pin> outputs;         // Block
  std::vector<ActionLine> actions;  // ActionBlock, Step
};

// "contact", "step": how messages call it.
[[nodiscard]] const char* word_of(Element::Kind kind) noexcept;
// "contact Start", "block TON0", "connector 3".
[[nodiscard]] std::string title_of(const Element& element);

struct Diagram {
  std::vector<Element> elements;  // in the order of the file

  // Null if there is none.
  [[nodiscard]] const Element* find(std::uint64_t id) const noexcept;
};

// The code of a POU, an action, a transition, in whichever language.
struct Body {
  enum class Language : std::uint8_t { None, St, Il, Ld, Fbd, Sfc };
  Language language = Language::None;
  Place at;
  std::string text;  // ST, IL
  Place text_at;
  Diagram diagram;  // LD, FBD, SFC
};

// An action or a transition.
struct NamedBody {
  Place at;
  std::string name;
  Body body;
};

// All code of a POU.
struct PouCode {
  Body body;
  std::vector<NamedBody> actions;
  std::vector<NamedBody> transitions;
};

}  // namespace indurop::plc::network
