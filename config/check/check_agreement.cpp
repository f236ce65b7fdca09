// SPDX-License-Identifier: Apache-2.0
// Modules built at different times or on different boards must use the same layout for what they share.

#include <map>

#include "config/check/check_parts.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

// Modules that share a name must share its layout: compares each with the first module that has it.
template <class T>
class Agreement {
 public:
  Agreement(base::Diagnostics& report, const char* what) : report_(report), what_(what) {}

  // `module` as shown in messages.
  template <class Difference>
  void add(const std::string& module, base::SourcePlace place, const std::vector<T>& items, Difference difference) {
    for (const T& item : items) {
      const auto [first, is_first] = first_.try_emplace(item.name, Entry{module, &item});
      if (is_first || first->second.item->type_hash == item.type_hash) {
        continue;
      }
      const std::string what = difference(*first->second.item, item);
      const auto source = [](const T& of) { return of.source.empty() ? std::string() : " (" + of.source + ")"; };
      std::string text = std::string(what_) + " " + base::in_quotes(item.name) + " differs between ";
      text += first->second.module + source(*first->second.item) + " and " + module + source(item) + ": ";
      text += (what.empty() ? "other layout" : what) + "; build both with the same .glb file";
      report_.error(place, std::move(text));
    }
  }

 private:
  struct Entry {
    std::string module;
    const T* item;
  };
  base::Diagnostics& report_;
  const char* what_;
  std::map<std::string, Entry> first_;
};

}  // namespace

void check_agreement(std::span<const BoardView> boards, base::Diagnostics& report) {
  Agreement<schema::Variable> variables(report, "variable");
  for (const BoardView& board : boards) {
    Agreement<schema::Function> functions(report, "shared function");  // calls do not leave a board
    Agreement<schema::Pool> pools(report, "pool");                     // nor do pools
    for (std::size_t i = 0; i < board.result.facts.size(); ++i) {
      const Module& module = board.config.modules[i];
      const schema::Schema& schema = *board.result.facts[i].schema;
      const std::string name = module.name + (board.name.empty() ? "" : "@" + board.name);
      variables.add(name, module.places.file, schema.variables,
                    [](const auto& a, const auto& b) { return schema::first_difference(a.type, b.type); });
      pools.add(name, module.places.file, schema.pools,
                [](const auto& a, const auto& b) { return schema::first_difference(a.type, b.type); });
      functions.add(name, module.places.file, schema.functions, [](const auto& a, const auto& b) {
        const std::string arguments = schema::first_difference(a.arguments, b.arguments);
        return !arguments.empty() ? "arguments: " + arguments
                                  : "result: " + schema::first_difference(a.result, b.result);
      });
    }
  }
}

}  // namespace indurop::config
