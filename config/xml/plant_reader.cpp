// SPDX-License-Identifier: Apache-2.0
// Reads the manifest of a plant from its elements.
#include "config/xml/plant_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>

#include "config/xml/attributes.h"
#include "config/xml/config_reader.h"
#include "config/xml/document.h"
#include "config/xml/element_rules.h"
#include "config/xml/external_reader.h"
#include "config/xml/plant_rules.h"
#include "config/xml/pool_reader.h"
#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr base::Nanos kShortestLease{std::chrono::milliseconds(20)};
constexpr base::Nanos kLongestLease{std::chrono::seconds(60)};
constexpr const char* kNameRule = "use up to 40 letters, digits, '_' and '-'";

class PlantReader {
 public:
  PlantReader(const base::Element& root, Plant& plant, base::Diagnostics& report)
      : root_(root), plant_(plant), report_(report), folder_(folder_of(plant.file)) {}

  void read() {
    if (root_.name != "plant") {
      report_.error(root_.place, "the root element is <" + root_.name + ">; a " + kPlantXml.name + " is " +
                                     kPlantXml.form +
                                     (root_.name == "root" ? "; this one is a module.xml, which needs no plant" : ""));
      return;
    }
    check_root_attributes(root_, {"name"}, report_);
    plant_.security_place = root_.place;
    check_no_text(root_, report_);
    if (const base::Attribute* name = need_attribute(root_, "name", "<plant name=\"cell\">", report_)) {
      plant_.name = checked_name(*name, "plant");
    }
    for (const base::Element& child : root_.children) {
      read_child(child);
    }
    if (!boards_given_) {
      report_.error(root_.place, "<plant> has no <board>; add one per board, with its modules in it");
    }
    add_standbys(plant_, report_);
    put_architectures(plant_, report_);
    for (const Board& board : plant_.boards) {
      if (board.config.modules.empty() && !board.name.empty() && !misspelt_.contains(board.name)) {
        report_.note(board.place, "the board " + base::in_quotes(board.name) +
                                      " has no <module>; it runs nothing and owns no variable");
      }
    }
    keep_secured();
    check_plant_rules(plant_, places_, report_);
  }

 private:
  // A plant with keys must not become open to other participants because an attribute is missing.
  void keep_secured() {
    if (!plant_.external_domain) {
      return;
    }
    if (plant_.security.empty()) {
      if (plant_.external_secure) {
        report_.error(
            places_.external,
            "secure=\"on\" needs keys of the plant; make them with indurop keys init, then say where they are "
            "with <security>keys</security>");
      }
      return;
    }
    if (places_.external.line == 0) {
      plant_.external_domain.reset();
    } else if (!plant_.types.empty() && !plant_.external_secure) {
      report_.warning(
          places_.external,
          "the boards are secured, this domain is not: anyone in the network reads the variables in it and "
          "sets those with external=\"write\"; write <external secure=\"on\">, or off, or keep it on a network of its "
          "own");
    }
  }

  struct Known {
    const char* name;
    bool repeatable;
    void (PlantReader::*read)(const base::Element&);
  };
  static std::span<const Known> known_elements() {
    static constexpr std::array<Known, 11> kKnown{{
        {"board", true, &PlantReader::read_board},
        {"variable", true, &PlantReader::read_variable},
        {"pool", true, &PlantReader::read_pool},
        {"domain", false, &PlantReader::read_domain},
        {"external", false, &PlantReader::read_external},
        {"multicast", false, &PlantReader::read_multicast},
        {"lease", false, &PlantReader::read_lease},
        {"network", false, &PlantReader::read_network},
        {"security", false, &PlantReader::read_security},
        {"sources", false, &PlantReader::read_sources},
        {"types", true, &PlantReader::read_types},
    }};
    return kKnown;
  }

  void read_child(const base::Element& child) {
    const auto known = known_elements();
    const auto found = std::find_if(known.begin(), known.end(), [&](const Known& k) { return child.name == k.name; });
    if (found == known.end()) {
      std::vector<std::string> names;
      for (const Known& k : known) {
        names.emplace_back(k.name);
      }
      boards_given_ = boards_given_ || base::closest_name(child.name, names) == "board";
      is_known(child, root_, names, report_);
    } else if (found->repeatable || is_first(child, "this <plant>", given_, report_)) {
      (this->*found->read)(child);
    }
  }

  // Returns empty after an error.
  std::string checked_name(const base::Attribute& name, const char* whose) {
    if (is_node_name(name.value)) {
      return name.value;
    }
    report_.error(name.value_place, base::in_quotes(name.value) + " is not a name of a " + whose + "; " + kNameRule);
    return {};
  }

  void read_domain(const base::Element& e) {
    if (const auto text = text_of(e, "77", report_)) {
      places_.domain = e.text_place;
      plant_.domain = domain_of(e, *text, "", report_).value_or(plant_.domain);
    }
  }

  void read_external(const base::Element& e) {
    check_attributes(e, {"ros2", "secure"}, report_);
    plant_.external_ros2 = is_on(e, "ros2", report_);
    plant_.external_secure = is_on(e, "secure", report_);
    if (!is_leaf(e, report_)) {
      return;
    }
    if (e.text.empty()) {
      report_.error(e.place, "<external> is empty; write, for example, <external>0</external>");
      return;
    }
    places_.external = e.text_place;
    plant_.external_domain = e.text == "off" ? std::nullopt : domain_of(e, e.text, ", or off", report_);
  }

  void read_multicast(const base::Element& e) { plant_.multicast = choose(e, {"on", "off"}, report_).value_or(0) == 0; }

  void read_lease(const base::Element& e) {
    const auto value = duration_of(e, false, report_);
    if (value && (*value < kShortestLease || *value > kLongestLease)) {
      report_.error(e.text_place, "<lease>: " + base::format_duration(*value) + " is not possible; write a time from " +
                                      base::format_duration(kShortestLease) + " to " +
                                      base::format_duration(kLongestLease));
      return;
    }
    plant_.lease = value.value_or(plant_.lease);
  }

  void read_network(const base::Element& e) {
    using Network = SimulatedNetwork;
    Attributes attributes(e, report_);
    Network& to = plant_.network;
    to.delay = attributes.duration("delay", Network::kLeastDelay, Network::kLongest).value_or(to.delay);
    to.jitter = attributes.duration("jitter", base::Nanos{0}, Network::kLongest).value_or(to.jitter);
    to.repeat = attributes.duration("repeat", Network::kLeastDelay, Network::kLongest).value_or(to.repeat);
    to.loss = attributes.real("loss", 0, Network::kMaxLoss).value_or(to.loss);
    to.seed = attributes.integer("seed", 0, INT64_MAX).value_or(to.seed);
    attributes.finish();
    check_no_text(e, report_);
  }

  void read_security(const base::Element& e) {
    const auto text = text_of(e, "keys", report_);
    if (!text) {
      return;
    }
    plant_.security_place = e.text_place;
    if (text->find_first_of("\r\n\t") != std::string::npos) {
      report_.error(e.text_place, "the name of the folder contains a tab or line break; write it in one line");
      return;
    }
    plant_.security = (folder_ / *text).lexically_normal();
  }

  void read_sources(const base::Element& e) {
    const auto text = text_of(e, "off", report_);
    if (!text) {
      return;
    }
    plant_.sources = *text != "off";
    if (plant_.sources) {
      plant_.sources_folder = (folder_ / *text).lexically_normal();
    }
  }

  void read_types(const base::Element& e) { read_type_file(e, folder_, plant_, report_); }

  void read_board(const base::Element& e) {
    boards_given_ = true;
    check_attributes(e, {"name", "address", "interface", "arch"}, report_);
    Board board;
    board.place = e.place;
    if (const base::Attribute* name = need_attribute(e, "name", "<board name=\"sensor\">", report_)) {
      board.name = checked_name(*name, "board");
    }
    board.address = optional_attribute(e, "address", address_problem, report_);
    board.interface_name = optional_attribute(e, "interface", interface_problem, report_);
    board.arch = optional_attribute(e, "arch", arch_problem, report_);
    board.config.file = plant_.file;
    read_configuration(e, board.config, report_);
    const bool misspelt = std::any_of(e.children.begin(), e.children.end(), [](const base::Element& child) {
      return !base::closest_name(child.name, {"module"}).empty();
    });
    if (misspelt) {
      misspelt_.insert(board.name);
    }
    plant_.boards.push_back(std::move(board));
  }

  void read_variable(const base::Element& e) {
    if (auto rule = read_rule(e, {"name", "owner", "every", "reliability", "external"}, variables_, report_)) {
      plant_.variables.push_back(std::move(*rule));
    }
  }

  void read_pool(const base::Element& e) {
    if (auto route = read_pool_route(e, pools_, report_)) {
      plant_.pools.push_back(std::move(*route));
    }
  }

  const base::Element& root_;
  Plant& plant_;
  base::Diagnostics& report_;
  std::filesystem::path folder_;
  FirstPlaces given_;
  FirstPlaces variables_;
  FirstPlaces pools_;
  PlantPlaces places_;
  std::set<std::string> misspelt_;  // boards with an unknown element that was probably intended as <module>
  bool boards_given_ = false;
};

}  // namespace

void interpret_plant(const base::Element& root, Plant& plant, std::vector<base::Diagnostic>& diagnostics) {
  base::Diagnostics report(plant.file.string(), diagnostics);
  PlantReader(root, plant, report).read();
  report.add_summary(diagnostics);
  base::sort_by_place(diagnostics);
}

bool ReadPlant::ok() const noexcept {
  return !base::has_error(diagnostics);
}

bool is_plant_file(const std::filesystem::path& file) {
  const auto bytes = read_bytes(file, kPlantXml);
  return bytes && root_name(*bytes) == "plant";
}

ReadPlant read_plant(const std::filesystem::path& file) {
  const auto bytes = read_bytes(file, kPlantXml);
  if (bytes) {
    return read_plant_text(*bytes, file);
  }
  ReadPlant result;
  result.plant.file = file;
  result.diagnostics.push_back(bytes.error());
  return result;
}

ReadPlant read_plant_text(std::string_view xml, const std::filesystem::path& pretend_file) {
  ReadPlant result;
  result.plant.file = pretend_file;
  if (const auto root = read_document(xml, pretend_file, kPlantXml, result.diagnostics)) {
    interpret_plant(*root, result.plant, result.diagnostics);
  }
  return result;
}

}  // namespace indurop::config
