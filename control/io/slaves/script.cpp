// SPDX-License-Identifier: Apache-2.0
#include "control/io/slaves/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "core/base/diagnostics.h"
#include "core/base/duration.h"
#include "core/base/text.h"

namespace indurop::io::slaves {

namespace {

using ethercat::Fault;
using ethercat::FaultKind;

constexpr std::uint32_t kMaxPpm = 10'000;

// What a line with this fault needs.
struct Form {
  std::string_view word;
  FaultKind kind;
  bool slave = false;
  bool lasts = false;
  std::string_view value{};  // name of the number, empty: none
};
constexpr std::array<Form, ethercat::kFaultKinds> kForms{
    {{"frames_lost", FaultKind::FramesLost, false, true},
     {"frames_late", FaultKind::FramesLate, false, true, "by"},
     {"frames_doubled", FaultKind::FramesDoubled, false, true},
     {"frames_swapped", FaultKind::FramesSwapped, false, true},
     {"frames_broken", FaultKind::FramesBroken, true, true},
     {"foreign_frame", FaultKind::ForeignFrame},
     {"wrong_counter", FaultKind::WrongCounter, true, true},
     {"power_off", FaultKind::PowerOff, true, true},
     {"state_refused", FaultKind::StateRefused, true, false, "code"},
     {"state_slow", FaultKind::StateSlow, true, true, "by"},
     {"state_lost", FaultKind::StateLost, true, false, "code"},
     {"sdo_aborted", FaultKind::SdoAborted, true, false, "code"},
     {"sdo_silence", FaultKind::SdoSilence, true},
     {"sdo_repeated", FaultKind::SdoRepeated, true, true},
     {"other_identity", FaultKind::OtherIdentity, true, true},
     {"eeprom_busy", FaultKind::EepromBusy, true, true},
     {"emergency", FaultKind::Emergency, true, false, "code"},
     {"clock_jumps", FaultKind::ClockJumps, true, false, "by"},
     {"clock_drifts", FaultKind::ClockDrifts, true, true, "ppm"},
     {"cable_cut", FaultKind::CableCut, true, true},
     {"value", FaultKind::ObjectSet, true, false, "to"}}};

std::string example_of(const Form& form) {
  std::string text(form.word);
  text += form.slave ? " slave=0" : "";
  text += form.lasts ? " for=5ms" : "";
  if (form.value == "by") {
    text += " by=2ms";
  } else if (form.value == "code") {
    text += " code=0x8611";
  } else if (form.value == "ppm") {
    text += " ppm=50";
  } else if (form.value == "to") {
    text += " at=6000:1 to=1";
  }
  return text;
}

struct Word {
  std::string text;
  int column = 0;
};

std::vector<Word> words_of(const std::string& line) {
  std::vector<Word> words;
  const std::string code = line.substr(0, line.find('#'));
  for (std::size_t at = code.find_first_not_of(" \t\r"); at != std::string::npos;) {
    const std::size_t end = std::min(code.find_first_of(" \t\r", at), code.size());
    words.push_back({code.substr(at, end - at), static_cast<int>(at) + 1});
    at = code.find_first_not_of(" \t\r", end);
  }
  return words;
}

std::optional<std::uint32_t> number_of(std::string_view text) {
  const bool hex = text.starts_with("0x");
  text.remove_prefix(hex ? 2 : 0);
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, hex ? 16 : 10);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// Index and subindex in hexadecimal digits, as manuals write them: 6000:1.
std::optional<std::uint32_t> object_of(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto index = number_of("0x" + std::string(text.substr(0, colon)));
  const auto subindex =
      colon == text.size() ? std::optional(0U) : number_of("0x" + std::string(text.substr(colon + 1)));
  return index && *index > 0 && *index <= 0xFFFF && subindex && *subindex <= 0xFF
             ? std::optional(*index << 8U | *subindex)
             : std::nullopt;
}

class LineReader {
 public:
  LineReader(int line, std::size_t slaves, base::Diagnostics& report) : line_(line), slaves_(slaves), report_(report) {}

  std::optional<Fault> read(const std::vector<Word>& words) {
    const auto at = base::read_duration(words[0].text, true);
    if (!at.value) {
      return wrong(words[0], fmt::format("{} is no time; write 0s, 500ms, 2s", base::in_quotes(words[0].text)));
    }
    fault_.at = *at.value;
    if (words.size() < 2 || !find_form(words[1])) {
      return words.size() < 2 ? wrong(words[0], "there is no fault after the time; write 2s frames_lost for=5ms")
                              : std::nullopt;
    }
    for (std::size_t i = 2; i < words.size(); ++i) {
      if (!read_value(words[i])) {
        return std::nullopt;
      }
    }
    const bool complete = has_slave_ == form_->slave && has_duration_ == form_->lasts &&
                          has_value_ == !form_->value.empty() && (fault_.object != 0) == (form_->value == "to");
    return complete ? std::optional(fault_)
                    : wrong(words[1], fmt::format("{} is written so: {}", form_->word, example_of(*form_)));
  }

 private:
  std::optional<Fault> wrong(const Word& word, const std::string& text) {
    report_.error({line_, word.column}, text);
    return std::nullopt;
  }

  bool find_form(const Word& word) {
    std::vector<std::string> known;
    for (const Form& form : kForms) {
      known.emplace_back(form.word);
      form_ = form.word == word.text ? &form : form_;
    }
    if (form_ == nullptr) {
      wrong(word,
            fmt::format("there is no fault {}{}", base::in_quotes(word.text), base::suggestion(word.text, known)));
      return false;
    }
    fault_.kind = form_->kind;
    return true;
  }

  bool read_value(const Word& word) {
    const std::size_t equals = word.text.find('=');
    const std::string name = word.text.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.text.substr(equals + 1);
    const auto number = number_of(value);
    const auto duration = base::parse_duration(value);
    const std::size_t places = slaves_ + (form_->kind == FaultKind::CableCut ? 1 : 0);  // behind the last one, too
    if (name == "slave" && number && *number < places) {
      fault_.slave = *number;
      has_slave_ = true;
    } else if (name == "for" && duration) {
      fault_.duration = *duration;
      has_duration_ = true;
    } else if (name == "by" && form_->value == "by" && duration && *duration < std::chrono::seconds(4)) {
      fault_.value = static_cast<std::uint32_t>(duration->count());
      has_value_ = true;
    } else if (name == "at" && form_->value == "to" && object_of(value)) {
      fault_.object = *object_of(value);
    } else if (name == form_->value && number &&
               (name == "to" || name == "code" || (name == "ppm" && *number <= kMaxPpm))) {
      fault_.value = *number;
      has_value_ = true;
    } else {
      wrong(word, fmt::format("{} is not possible here; {} is written so: {}{}", base::in_quotes(word.text),
                              form_->word, example_of(*form_),
                              name == "slave" ? fmt::format(", with a slave from 0 to {}", places - 1) : ""));
      return false;
    }
    return true;
  }

  int line_;
  std::size_t slaves_;
  base::Diagnostics& report_;
  const Form* form_ = nullptr;
  Fault fault_;
  bool has_slave_ = false;
  bool has_duration_ = false;
  bool has_value_ = false;
};

}  // namespace

std::string script_help() {
  std::string text;
  for (const Form& form : kForms) {
    text += fmt::format("  2s {}\n", example_of(form));
  }
  return text;
}

Script read_script(const std::string& text, const std::filesystem::path& file, std::size_t slaves) {
  Script script;
  base::Diagnostics report(file.string(), script.diagnostics);
  int number = 0;
  for (const std::string& line : base::lines_of(text)) {
    ++number;
    const auto words = words_of(line);
    if (words.empty()) {
      continue;
    }
    if (const auto fault = LineReader(number, slaves, report).read(words)) {
      script.faults.push_back(*fault);
    }
  }
  return script;
}

}  // namespace indurop::io::slaves
