// SPDX-License-Identifier: Apache-2.0
// `indurop-solids`: rewrites a URDF file with boxes, cylinders and spheres around the meshes that its links collide
// with. It is a separate program, since the library that reads meshes takes 30 ms to load.

#include <fmt/format.h>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/text.h"
#include "tools/console/diagnostics.h"
#include "tools/solids/around.h"
#include "tools/solids/beyond.h"
#include "tools/solids/mesh_file.h"
#include "tools/solids/picture.h"
#include "tools/solids/urdf_meshes.h"

namespace indurop::solids {
namespace {

constexpr const char* kDetails = R"(The robot checks boxes, cylinders and balls for collisions, not meshes. Every point
of a mesh, and of what it encloses, is in one of its solids; BEYOND is the maximum
distance by which they exceed it. More solids fit closer, and take longer to check;
64 are possible for all links. Meshes: STL, DAE, OBJ and all others that assimp
reads. Inspect the picture before the robot moves.

Without a second file nothing is written. Use that file in the robot module, and
run 'indurop check'.
  indurop-solids arm.urdf arm_solids.urdf --svg arm_solids.svg
  indurop-solids arm.urdf --package arm_description=/opt/arm/description
)";

struct Options {
  std::filesystem::path urdf, output, svg;
  double within_mm = 20;
  int most = 4;
  std::vector<std::string> packages;  // NAME=FOLDER
};

std::string mistake_of_package(const std::string& text) {
  const std::size_t equals = text.find('=');
  const bool fine = equals != 0 && equals != std::string::npos && equals + 1 != text.size();
  return fine ? "" : fmt::format("write NAME=FOLDER, not {}", base::in_quotes(text));
}

Packages packages_of(const Options& options) {
  Packages packages;
  for (const std::string& text : options.packages) {
    const std::size_t equals = text.find('=');
    packages[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return packages;
}

void place_in_link(Surface& surface, const robot::Pose& origin) {
  for (Triangle& triangle : surface) {
    for (Vec3& corner : triangle) {
      corner = origin.position + origin.orientation * corner;
    }
  }
}

// Returns the surfaces of all meshes, each in the frame of its link; adds errors to `mistakes`.
std::vector<Surface> read_all(const Options& options, const std::vector<CollisionMesh>& meshes,
                              std::vector<base::Diagnostic>& mistakes) {
  const Packages packages = packages_of(options);
  std::vector<Surface> surfaces;
  for (const CollisionMesh& mesh : meshes) {
    const auto complain = [&](const base::Problem& problem) {
      mistakes.push_back({base::Diagnostic::Severity::Error, options.urdf.string(), mesh.place,
                          fmt::format("link '{}': mesh {} cannot be read: {}", mesh.link,
                                      base::path_in_quotes(mesh.uri), problem.text)});
    };
    const auto file = mesh_file(mesh.uri, options.urdf, packages);
    if (!file) {
      complain(file.error());
      continue;
    }
    auto surface = read_mesh(*file, mesh.scale);
    if (!surface) {
      complain(surface.error());
      continue;
    }
    place_in_link(*surface, mesh.origin);
    surfaces.push_back(std::move(*surface));
  }
  return surfaces;
}

std::string names_of(const std::vector<Solid>& solids) {
  std::vector<std::string> names;
  for (const Solid& solid : solids) {
    names.emplace_back(solid.kind == robot::SolidKind::Box        ? "box"
                       : solid.kind == robot::SolidKind::Cylinder ? "cylinder"
                                                                  : "ball");
  }
  return base::enumerate(names, names.size());
}

// Returns the exit code.
int write(tools::Context& context, const std::filesystem::path& file, const std::string& text) {
  if (file.empty()) {
    return kOk;
  }
  if (const auto written = base::replace_file(file, text, base::Durable::Yes); !written) {
    context.out.error(base::cannot_write(file, written.error()));
    return kFailed;
  }
  return kOk;
}

int run(tools::Context& context, const Options& options) {
  const auto text = base::read_file(options.urdf);
  if (!text) {
    context.out.error(base::cannot_read(options.urdf, text.error()));
    return kFailed;
  }
  FoundMeshes found = find_meshes(options.urdf.string(), *text);
  const std::vector<Surface> surfaces = read_all(options, found.meshes, found.mistakes);
  if (!found.mistakes.empty()) {
    tools::print_diagnostics(context, found.mistakes, false);
    return kCheckFailed;
  }
  tools::Table table({{"LINK", "link"},
                      {"MESH", "mesh"},
                      {"TRIANGLES", "triangles", tools::Align::Right},
                      {"BEYOND", "beyond_mm", tools::Align::Right},
                      {"SOLIDS", "solids"}});
  std::vector<std::vector<Solid>> solids;
  std::vector<DrawnMesh> drawn;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const CollisionMesh& mesh = found.meshes[i];
    const Mat3 frames[] = {Mat3::Identity(), mesh.origin.orientation.toRotationMatrix()};
    solids.push_back(solids_around(surfaces[i], {options.within_mm / 1000, options.most}, frames));
    const double most = 1000 * beyond(solids[i], surfaces[i]);
    table.add({tools::Cell(mesh.link), tools::Cell(mesh.uri),
               tools::Cell(fmt::format("{}", surfaces[i].size()), surfaces[i].size()),
               tools::Cell(fmt::format("{:.1f} mm", most), most), tools::Cell(names_of(solids[i]))});
    drawn.push_back({mesh.link + ", " + std::filesystem::path(mesh.uri).filename().string(), surfaces[i], solids[i]});
  }
  if (table.empty()) {
    context.out.note(fmt::format("no link of {} collides with a mesh", options.urdf.string()));
  }
  tools::print_table(context, table, {{"file", options.urdf.string()}}, "meshes");
  if (const int code = write(context, options.svg, options.svg.empty() ? "" : draw(drawn)); code != kOk) {
    return code;
  }
  return write(context, options.output, with_solids(*text, found.meshes, solids));
}

}  // namespace
}  // namespace indurop::solids

int main(int argc, char** argv) {
  using namespace indurop;
  tools::Context context;
  solids::Options options;
  base::Options app("indurop-solids", "Put boxes, cylinders and balls around the meshes of a robot");
  app.version(INDUROP_VERSION);
  app.add("file", "ARM.urdf", options.urdf, "Description of the robot").required().completes(base::Completion::File);
  app.add("to", "NEW.urdf", options.output, "File to write, with solids instead of meshes")
      .completes(base::Completion::File);
  app.add("--within", "MM", options.within_mm, "Maximum distance by which solids may exceed a mesh (default: 20)")
      .range(1, 1000);
  app.add("--most", "N", options.most, "Maximum number of solids per mesh (default: 4)").range(1, 16);
  app.add("--package", "NAME=FOLDER", options.packages, "Folder of package://NAME/, if it does not contain the file")
      .check(solids::mistake_of_package)
      .one_at_a_time();
  app.add("--svg", "FILE", options.svg, "A picture of the meshes and their solids").completes(base::Completion::File);
  tools::add_format_option(app, context, {tools::Format::Table, tools::Format::Json, tools::Format::Csv});
  app.details(solids::kDetails);
  app.exit_codes({kOk, kFailed, kUsage, kCheckFailed});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  const int code = solids::run(context, options);
  return context.out.flush() ? code : kFailed;
}
