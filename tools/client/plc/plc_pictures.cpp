// SPDX-License-Identifier: Apache-2.0
#include "tools/client/plc/plc_pictures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "control/plc/front/check_files.h"
#include "control/plc/front/watch_plan.h"
#include "control/plc/print/live.h"
#include "tools/client/plc/plc_view.h"

namespace indurop::tools {
namespace {

plc::CompileOptions options_of(const PlcFiles& files) {
  plc::CompileOptions compile;
  compile.files = files.files;
  compile.glb_files = files.glb_files;
  compile.name = files.name;
  compile.space = files.space;
  return compile;
}

PlcFiles files_of(const std::string& words) {
  PlcFiles out;
  std::string_view rest = words;
  if (const auto end = rest.find('='); end != std::string_view::npos) {
    const std::string_view name = rest.substr(0, end);
    const auto colon = std::min(name.find(':'), name.size());
    out.name = name.substr(0, colon);
    out.space = name.substr(std::min(colon + 1, name.size()));
    rest.remove_prefix(end + 1);
  }
  while (!rest.empty()) {
    const auto end = std::min(rest.find(','), rest.size());
    const std::string file(rest.substr(0, end));
    if (!file.empty()) {
      (file.ends_with(".glb") ? out.glb_files : out.files).push_back(file);
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return out;
}

}  // namespace

struct PlcPictures::Program {
  // A view of one node.
  struct Watched {
    KeptMessages messages;
    Access access;
    std::unique_ptr<PlcView> view;
  };

  std::string name;
  plc::CompileOptions compile;
  std::optional<plc::WatchPlan> plan;
  std::map<std::string, std::unique_ptr<Watched>> nodes;

  Result<void, Failure> read() {
    if (plan && plan->ok) {
      return {};
    }
    plan = plc::watch_plan(compile);
    if (plan->ok) {
      return {};
    }
    std::string first = plan->diagnostics.empty() ? "it cannot be read" : base::to_string(plan->diagnostics[0]);
    constexpr std::string_view kOption = " with --glb";  // not an option of the server
    if (const auto at = first.find(kOption); at != std::string::npos) {
      first.erase(at, kOption.size());
    }
    const std::string hint =
        compile.glb_files.empty()
            ? fmt::format("; .glb files whose variables it uses are named after it: --plc {},robot.glb",
                          compile.files.front())
            : std::string();
    return Failure{kCheckFailed, fmt::format("the PLC program has errors: {}{}", first, hint)};
  }

  // The program of a node was exchanged: its files may be new, too, and are read again at the next request.
  Failure forget(Failure why) {
    nodes.clear();
    plan.reset();
    return why;
  }

  Result<PlcView*, Failure> view_of(const std::string& node) {
    if (auto done = read(); !done) {
      return std::move(done).error();
    }
    auto& watched = nodes[node];
    if (watched != nullptr && watched->view != nullptr) {
      if (auto sampled = watched->view->sample(); !sampled) {
        return forget(std::move(sampled).error());
      }
      return watched->view.get();
    }
    watched = std::make_unique<Watched>();
    watched->access.node = node;
    watched->access.messages = &watched->messages;
    plc::Diagnostics quiet;  // errors were reported already
    auto view =
        std::make_unique<PlcView>(watched->access, *plan, plc::live_bodies(plan->document, "", quiet), ViewChoice{});
    if (auto opened = view->open(); !opened) {
      Failure why = std::move(opened).error();
      if (why.text.empty()) {
        why.text = fmt::format("{}", fmt::join(watched->messages.texts, "; "));
      }
      view.reset();
      return why.code == kSchemaMismatch ? forget(std::move(why)) : why;
    }
    watched->view = std::move(view);
    return watched->view.get();
  }
};

Result<std::vector<PlcFiles>, Failure> plc_programs(const std::vector<std::string>& words) {
  std::vector<PlcFiles> out;
  for (const std::string& each : words) {
    PlcFiles files = files_of(each);
    if (files.files.empty()) {
      return Failure{kUsage, fmt::format("--plc {} names no file", each)};
    }
    files.name = plc::module_name(options_of(files));
    if (std::any_of(out.begin(), out.end(), [&](const PlcFiles& one) { return one.name == files.name; })) {
      return Failure{
          kUsage, fmt::format("two PLC programs are called {0}: files of one program are --plc {1},{2}, a program of "
                              "another name is --plc NAME={2}",
                              files.name, out.back().files.front(), files.files.front())};
    }
    out.push_back(std::move(files));
  }
  return out;
}

PlcPictures::PlcPictures(const std::vector<PlcFiles>& programs) {
  for (const PlcFiles& files : programs) {
    auto& program = programs_.emplace_back(std::make_unique<Program>());
    program->name = files.name;
    program->compile = options_of(files);
  }
}

PlcPictures::~PlcPictures() = default;

Result<base::Json, Failure> PlcPictures::answer(const std::string& node, const std::string& program, bool check_node,
                                                Answer what) {
  std::optional<Failure> failure;
  base::Json names = base::Json::array();
  for (const auto& one : programs_) {
    names.push_back(one->name);
  }
  for (const auto& one : programs_) {
    if (!program.empty() && one->name != program) {
      continue;
    }
    if (check_node) {
      one->nodes.erase(node);  // checks again whether the node runs this program
    }
    auto view = one->view_of(node);
    if (view) {
      base::Json out = ((*view)->*what)();
      out["program"] = one->name;
      out["programs"] = std::move(names);
      return out;
    }
    if (!failure) {
      failure = std::move(view).error();
    }
  }
  return failure ? std::move(*failure) : Failure{kUsage, fmt::format("there is no PLC program '{}' here", program)};
}

Result<base::Json, Failure> PlcPictures::pictures(const std::string& node, const std::string& program) {
  return answer(node, program, true, &PlcView::pictures);
}

Result<base::Json, Failure> PlcPictures::model(const std::string& node, const std::string& program) {
  return answer(node, program, true, &PlcView::model);
}

Result<base::Json, Failure> PlcPictures::live(const std::string& node, const std::string& program) {
  return answer(node, program, false, &PlcView::live);
}

}  // namespace indurop::tools
