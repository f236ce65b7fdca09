// SPDX-License-Identifier: Apache-2.0
#include "control/io/esi/esi_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <optional>
#include <utility>

#include "control/io/esi/esi_element.h"
#include "core/base/read_file.h"
#include "core/base/xml.h"

namespace indurop::io::esi {

namespace {

using ethercat::FmmuUse;
using ethercat::Pdo;
using ethercat::Sii;
using ethercat::SyncManagerUse;

constexpr std::uint32_t kByte = 0xFF;
constexpr std::uint32_t kWord = 0xFFFF;
constexpr std::uint32_t kLong = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMaxManagers = 16;

base::XmlRules rules() {
  constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;
  constexpr std::size_t kMaxDepth = 64;
  base::XmlRules rules;
  rules.name = "ESI file";
  rules.form = "<EtherCATInfo> with <Vendor> and <Descriptions>";
  rules.purpose = "description of devices";
  rules.max_bytes = kMaxBytes;
  rules.max_depth = kMaxDepth;
  rules.tolerant = true;
  return rules;
}

// Many of these files are in ISO 8859-1, whose bytes are the first characters of Unicode.
std::string to_utf8(std::string_view xml) {
  std::string head(xml.substr(0, xml.find("?>")));
  std::transform(head.begin(), head.end(), head.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  const std::size_t at = head.find("encoding=");
  const std::size_t begin = at + std::string_view("encoding='").size();
  const bool is_latin = at != std::string::npos && begin < head.size() && head.compare(begin, 3, "iso") == 0 &&
                        head.find("8859-1", begin) != std::string::npos;
  if (!is_latin) {
    return std::string(xml);
  }
  const std::size_t end = head.find(head[begin - 1], begin);
  std::string out(xml.substr(0, begin));
  out += "UTF-8";
  for (const char c : xml.substr(std::min(end, xml.size()))) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0U | byte >> 6U);
      out += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return out;
}

template <class Use>
struct UseWord {
  std::string_view word;
  Use use;
};
constexpr std::array<UseWord<FmmuUse>, 3> kFmmuWords{
    {{"Outputs", FmmuUse::Outputs}, {"Inputs", FmmuUse::Inputs}, {"MBoxState", FmmuUse::MailboxState}}};
constexpr std::array<UseWord<SyncManagerUse>, 4> kManagerWords{{{"MBoxOut", SyncManagerUse::MailboxOut},
                                                                {"MBoxIn", SyncManagerUse::MailboxIn},
                                                                {"Outputs", SyncManagerUse::Outputs},
                                                                {"Inputs", SyncManagerUse::Inputs}}};

template <class Words>
auto use_of(const Words& words, const std::string& word, decltype(words[0].use) other) {
  const auto* const found =
      std::find_if(words.begin(), words.end(), [&word](const auto& known) { return known.word == word; });
  return found == words.end() ? other : found->use;
}

class DeviceReader {
 public:
  explicit DeviceReader(const EsiElement& element) : element_(element) {}

  Device read() {
    device_.place = element_.place();
    if (const auto type = element_.need("Type")) {
      device_.type = type->text();
      sii().identity.product = type->number("ProductCode", kLong);
      sii().identity.revision = type->number("RevisionNo", kLong);
      sii().no_lrw = type->flag("UseLrdLwr");
    }
    sii().order = device_.type;
    sii().name = element_.english("Name");
    device_.has_modules = element_.has("Slots");
    read_managers();
    read_mailbox();
    for (const EsiElement& pdo : element_.all("RxPdo")) {
      sii().outputs.push_back(read_pdo(pdo, SyncManagerUse::Outputs));
    }
    for (const EsiElement& pdo : element_.all("TxPdo")) {
      sii().inputs.push_back(read_pdo(pdo, SyncManagerUse::Inputs));
    }
    if (const auto clocks = element_.find("Dc")) {
      for (const EsiElement& mode : clocks->all("OpMode")) {
        device_.modes.push_back(read_mode(mode));
      }
    }
    return std::move(device_);
  }

 private:
  Sii& sii() { return device_.sii; }

  void read_managers() {
    for (const EsiElement& fmmu : element_.all("Fmmu")) {
      sii().fmmus.push_back(use_of(kFmmuWords, fmmu.text(), FmmuUse::Unused));
    }
    for (const EsiElement& manager : element_.all("Sm")) {
      const SyncManagerUse use = use_of(kManagerWords, manager.text(), SyncManagerUse::None);
      if (sii().sync_managers.size() == kMaxManagers) {
        manager.error("<Sm>: a device has at most 16");
        return;
      }
      sii().sync_managers.push_back({static_cast<std::uint16_t>(manager.number("StartAddress", kWord)),
                                     static_cast<std::uint16_t>(manager.number("DefaultSize", kWord)),
                                     static_cast<std::uint8_t>(manager.number("ControlByte", kByte)),
                                     static_cast<std::uint8_t>(manager.number("Enable", kByte)), use});
    }
  }

  void read_mailbox() {
    const auto mailbox = element_.find("Mailbox");
    if (!mailbox) {
      return;
    }
    auto& area = sii().mailbox;
    for (const ethercat::SyncManagerEntry& manager : sii().sync_managers) {
      if (manager.use == SyncManagerUse::MailboxOut) {
        area.receive_at = manager.start;
        area.receive_size = manager.length;
      } else if (manager.use == SyncManagerUse::MailboxIn) {
        area.send_at = manager.start;
        area.send_size = manager.length;
      }
    }
    if (area.receive_size == 0 || area.send_size == 0) {
      mailbox->error("a device with <Mailbox> needs <Sm> of MBoxOut and of MBoxIn, with StartAddress and DefaultSize");
    }
    constexpr std::array<std::pair<const char*, std::uint16_t>, 5> kProtocols{{{"AoE", ethercat::kProtocolAoe},
                                                                               {"EoE", ethercat::kProtocolEoe},
                                                                               {"CoE", ethercat::kProtocolCoe},
                                                                               {"FoE", ethercat::kProtocolFoe},
                                                                               {"SoE", ethercat::kProtocolSoe}}};
    for (const auto& [name, bit] : kProtocols) {
      sii().protocols = static_cast<std::uint16_t>(sii().protocols | (mailbox->has(name) ? bit : 0U));
    }
    if (const auto coe = mailbox->find("CoE")) {
      read_coe(*coe);
    }
  }

  void read_coe(const EsiElement& coe) {
    constexpr std::array<std::pair<const char*, std::uint8_t>, 5> kDetails{
        {{"SdoInfo", ethercat::kCoeSdoInfo},
         {"PdoAssign", ethercat::kCoePdoAssign},
         {"PdoConfig", ethercat::kCoePdoConfiguration},
         {"PdoUpload", ethercat::kCoePdoUpload},
         {"CompleteAccess", ethercat::kCoeCompleteAccess}}};
    unsigned details = ethercat::kCoeSdo;
    for (const auto& [name, bit] : kDetails) {
      details |= coe.flag(name) ? bit : 0U;
    }
    sii().coe_details = static_cast<std::uint8_t>(details);
    for (const EsiElement& element : coe.all("InitCmd")) {
      InitCommand command;
      const auto index = element.need("Index");
      const auto data = element.need("Data");
      command.index = static_cast<std::uint16_t>(index ? index->number(kWord) : 0);
      const auto subindex = element.find("SubIndex");
      command.subindex = static_cast<std::uint8_t>(subindex ? subindex->number(kByte) : 0);
      command.complete = element.flag("CompleteAccess");
      for (const EsiElement& transition : element.all("Transition")) {
        command.transitions.push_back(transition.text());
      }
      command.data = data ? data->bytes() : std::vector<std::uint8_t>();
      command.comment = element.english("Comment");
      device_.commands.push_back(std::move(command));
    }
  }

  Pdo read_pdo(const EsiElement& element, SyncManagerUse use) {
    Pdo pdo;
    const auto index = element.need("Index");
    pdo.index = static_cast<std::uint16_t>(index ? index->number(kWord) : 0);
    pdo.name = element.english("Name");
    pdo.flags = static_cast<std::uint16_t>((element.flag("Mandatory") ? ethercat::kPdoMandatory : 0U) |
                                           (element.flag("Fixed") ? ethercat::kPdoFixed : 0U));
    if (element.attribute("Sm")) {
      pdo.sync_manager = static_cast<std::uint8_t>(element.number("Sm", kMaxManagers - 1));
      const auto& managers = sii().sync_managers;
      if (pdo.sync_manager >= managers.size() || managers[pdo.sync_manager].use != use) {
        element.error(fmt::format("PDO {:04x}h: there is no <Sm> {} of {}", pdo.index, pdo.sync_manager,
                                  use == SyncManagerUse::Outputs ? "outputs" : "inputs"));
      }
    }
    for (const EsiElement& other : element.all("Exclude")) {
      pdo.excludes.push_back(static_cast<std::uint16_t>(other.number(kWord)));
    }
    for (const EsiElement& entry : element.all("Entry")) {
      pdo.entries.push_back(read_entry(entry));
    }
    return pdo;
  }

  static ethercat::PdoEntry read_entry(const EsiElement& element) {
    ethercat::PdoEntry entry;
    const auto index = element.need("Index");
    const auto bits = element.need("BitLen");
    entry.index = static_cast<std::uint16_t>(index ? index->number(kWord) : 0);
    entry.bits = static_cast<std::uint8_t>(bits ? bits->number(kByte) : 0);
    const auto subindex = element.find("SubIndex");
    entry.subindex = static_cast<std::uint8_t>(subindex ? subindex->number(kByte) : 0);
    entry.name = element.english("Name");
    const auto type = element.find("DataType");
    entry.type = type ? coe_type_of(type->text()) : std::uint8_t{0};
    return entry;
  }

  static OpMode read_mode(const EsiElement& element) {
    OpMode mode;
    const auto name = element.need("Name");
    const auto activate = element.need("AssignActivate");
    mode.name = name ? name->text() : std::string();
    mode.description = element.english("Desc");
    mode.assign_activate = static_cast<std::uint16_t>(activate ? activate->number(kWord) : 0);
    const auto time = [&element](const char* child, std::int64_t& ns, std::int32_t* factor) {
      if (const auto found = element.find(child)) {
        ns = found->whole();
        if (factor != nullptr) {
          *factor = static_cast<std::int32_t>(found->whole("Factor"));
        }
      }
    };
    time("CycleTimeSync0", mode.cycle0, &mode.factor0);
    time("ShiftTimeSync0", mode.shift0, nullptr);
    time("CycleTimeSync1", mode.cycle1, &mode.factor1);
    return mode;
  }

  const EsiElement& element_;
  Device device_;
};

void interpret(const EsiElement& root, std::vector<Device>& devices) {
  if (root.name() != "EtherCATInfo") {
    root.error(
        fmt::format("the root element is <{}>, not the one of an ESI file: that is {}", root.name(), rules().form));
    return;
  }
  const auto vendor = root.need("Vendor");
  const auto id = vendor ? vendor->need("Id") : std::nullopt;
  const std::uint32_t number = id ? id->number(kLong) : 0;
  const auto descriptions = root.need("Descriptions");
  const auto list = descriptions ? descriptions->need("Devices") : std::nullopt;
  for (const EsiElement& element : list ? list->all("Device") : std::vector<EsiElement>()) {
    Device device = DeviceReader(element).read();
    device.vendor = vendor->english("Name");
    device.sii.identity.vendor = number;
    devices.push_back(std::move(device));
  }
}

}  // namespace

std::uint8_t coe_type_of(std::string_view name) noexcept {
  struct Type {
    std::string_view name;
    std::uint8_t number;
  };
  constexpr std::array<Type, 26> kTypes{
      {{"BOOL", 0x01},     {"BIT", 0x01},     {"SINT", 0x02}, {"INT", 0x03},    {"DINT", 0x04},   {"USINT", 0x05},
       {"UINT", 0x06},     {"UDINT", 0x07},   {"REAL", 0x08}, {"INT24", 0x10},  {"LREAL", 0x11},  {"INT40", 0x12},
       {"INT48", 0x13},    {"INT56", 0x14},   {"LINT", 0x15}, {"UINT24", 0x16}, {"UINT40", 0x18}, {"UINT48", 0x19},
       {"UINT56", 0x1A},   {"ULINT", 0x1B},   {"BYTE", 0x1E}, {"WORD", 0x1F},   {"DWORD", 0x20},  {"BITARR8", 0x2D},
       {"BITARR16", 0x2E}, {"BITARR32", 0x2F}}};
  const auto* const found =
      std::find_if(kTypes.begin(), kTypes.end(), [name](const Type& type) { return type.name == name; });
  if (found != kTypes.end()) {
    return found->number;
  }
  const bool is_bits = name.size() == 4 && name.starts_with("BIT") && name[3] >= '1' && name[3] <= '8';
  return is_bits ? static_cast<std::uint8_t>(0x30 + name[3] - '1') : std::uint8_t{0};
}

const Device* find_device(const EsiFile& esi, std::string_view type) {
  const Device* found = nullptr;
  for (const Device& device : esi.devices) {
    if (type.empty() ? esi.devices.size() == 1 : device.type == type) {
      const bool is_newer = found == nullptr || device.sii.identity.revision > found->sii.identity.revision;
      found = is_newer ? &device : found;
    }
  }
  return found;
}

std::vector<std::string> types_of(const EsiFile& esi) {
  std::vector<std::string> types;
  for (const Device& device : esi.devices) {
    if (std::find(types.begin(), types.end(), device.type) == types.end()) {
      types.push_back(device.type);
    }
  }
  return types;
}

EsiFile read_esi_text(std::string_view xml, const std::filesystem::path& pretend_file) {
  EsiFile esi;
  base::Diagnostics report(pretend_file.string(), esi.diagnostics);
  std::vector<base::XmlMistake> mistakes;
  const auto root = base::read_xml(to_utf8(xml), rules(), mistakes);
  for (base::XmlMistake& mistake : mistakes) {
    report.error(mistake.place, std::move(mistake.text));
  }
  if (root) {
    interpret(EsiElement(*root, report), esi.devices);
  }
  base::sort_by_place(esi.diagnostics);
  report.add_summary(esi.diagnostics);
  return esi;
}

EsiFile read_esi(const std::filesystem::path& file) {
  const auto text = base::read_file(file);
  if (!text) {
    EsiFile esi;
    base::Diagnostics(file.string(), esi.diagnostics).error({}, base::cannot_read(file, text.error()));
    return esi;
  }
  return read_esi_text(*text, file);
}

}  // namespace indurop::io::esi
