// SPDX-License-Identifier: Apache-2.0
#include "tools/plc/plc_pictures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <optional>
#include <utility>

#include "plc/front/watch_plan.h"
#include "plc/print/live.h"
#include "tools/plc/plc_view.h"

namespace indurop::tools {

struct PlcPictures::Impl {
  // A view of one node.
  struct Watched {
    Context context;
    std::vector<std::string> said;
    std::unique_ptr<PlcView> view;
  };

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
    const std::string first = plan->diagnostics.empty() ? "it cannot be read" : base::to_string(plan->diagnostics[0]);
    return Failure{kCheckFailed, fmt::format("the PLC program has errors: {}", first)};
  }

  Result<PlcView*, Failure> view_of(const std::string& node) {
    if (auto done = read(); !done) {
      return std::move(done).error();
    }
    auto& watched = nodes[node];
    if (watched != nullptr && watched->view != nullptr) {
      watched->view->sample();
      return watched->view.get();
    }
    watched = std::make_unique<Watched>();
    watched->context.node = node;
    watched->context.out.divert(&watched->said);
    plc::Diagnostics quiet;  // what is wrong was said
    auto view =
        std::make_unique<PlcView>(watched->context, *plan, plc::live_bodies(plan->document, "", quiet), ViewChoice{});
    if (auto opened = view->open(); !opened) {
      const Failure& why = opened.error();
      return Failure{why.code, why.text.empty() ? fmt::format("{}", fmt::join(watched->said, "; ")) : why.text};
    }
    watched->view = std::move(view);
    return watched->view.get();
  }
};

PlcPictures::PlcPictures(PlcFiles files) : impl_(std::make_unique<Impl>()) {
  impl_->compile.files = std::move(files.files);
  impl_->compile.glb_files = std::move(files.glb_files);
  impl_->compile.name = std::move(files.name);
  impl_->compile.space = std::move(files.space);
}

PlcPictures::~PlcPictures() = default;

Result<base::Json, Failure> PlcPictures::pictures(const std::string& node) {
  impl_->nodes.erase(node);  // looks anew whether the node runs this program
  auto view = impl_->view_of(node);
  return view ? Result<base::Json, Failure>((*view)->pictures()) : std::move(view).error();
}

Result<base::Json, Failure> PlcPictures::live(const std::string& node) {
  auto view = impl_->view_of(node);
  return view ? Result<base::Json, Failure>((*view)->live()) : std::move(view).error();
}

}  // namespace indurop::tools
