#include "dynamics/overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/words.hpp"
#include "dynamics/thickness.hpp"

namespace nereid::dynamics {

namespace {

/// Thickness of the plates of a region; zero if no block has it. [m]
double thickness(const Model& model, const std::string& region) {
  for (const auto& block : model.blocks)
    if (element::name(block) == region) return element::thickness(block);
  return 0;
}

/// The least contact height of apexes on a surface; infinite if it has none. [m]
double least_height(const contact::Interface& interface, const audit::Surface& surface) {
  double least = INFINITY;
  for (std::size_t a = 0; a < interface.apexes.size(); ++a)
    if (std::binary_search(surface.nodes.begin(), surface.nodes.end(), interface.apexes[a]))
      least = std::min(least, interface.contact_height(static_cast<Index>(a)));
  return least;
}

bool is_base(const contact::Interface& interface, const audit::Surface& surface) {
  const auto has = [&](Index n) { return std::binary_search(surface.nodes.begin(), surface.nodes.end(), n); };
  const auto all = interface.base.facets.colwise();
  return std::any_of(all.begin(), all.end(), [&](const auto& facet) { return has(facet(0)) && has(facet(1)) && has(facet(2)); });
}

bool has_apexes(const contact::Interface& interface, const audit::Surfaces& all, Index piece) {
  return std::any_of(interface.apexes.begin(), interface.apexes.end(), [&](Index n) { return all.piece_of_node[n] == piece; });
}

bool has_base(const contact::Interface& interface, const audit::Surfaces& all, Index piece) {
  const Table<3>& facets = interface.base.facets;
  for (Index f = 0; f < facets.cols(); ++f)
    if (all.piece_of_node[facets(0, f)] == piece) return true;
  return false;
}

std::int64_t edges(const audit::Surfaces& all) {
  std::int64_t sum = 0;
  for (const audit::Surface& surface : all.list) sum += surface.edges.cols();
  return sum;
}

const std::string& name(const audit::Surfaces& all, Index region) { return all.names[static_cast<std::size_t>(region)]; }

}  // namespace

audit::Surfaces audited_surfaces(const Model& model) {
  std::vector<double> thicknesses;
  for (const mesh::Triangles& region : model.mesh.triangles) thicknesses.push_back(thickness(model, region.name));
  std::vector<audit::Symmetry> planes;
  for (const load::Plane& plane : model.constraints.planes)
    if (plane.kind == load::PlaneKind::symmetry) planes.push_back({plane.normal, plane.nodes});
  audit::Surfaces all = audit::surfaces(model.mesh, thicknesses, planes);
  const auto set_round = [&](audit::Surface& surface) {
    if (surface.nodes.empty() || model.rigid_of_node.empty()) return;
    const Index body = model.rigid_of_node[static_cast<std::size_t>(surface.nodes[0])];
    if (body >= 0) surface.round = model.rigid_bodies[static_cast<std::size_t>(body)].round;
  };
  for (audit::Surface& surface : all.list) set_round(surface);
  for (audit::Surface& surface : all.shells) set_round(surface);
  return all;
}

std::map<std::array<Index, 2>, double> allowed_overlaps(const Model& model, const audit::Surfaces& all) {
  std::map<std::array<Index, 2>, double> allowed;
  const auto count = static_cast<Index>(all.list.size());
  for (const contact::AnyContact& any : model.contacts) {
    if (contact::interface_of(any) == nullptr) continue;
    const contact::Interface& interface = *contact::interface_of(any);
    if (interface.kind != contact::InterfaceKind::contact) continue;  // ties stay where they were at the start, which is accepted
    if (interface.bodies.count() > 0) continue;  // they touch at all of their thickness
    for (Index one = 0; one < count; ++one) {
      const double height = std::max(0.0, least_height(interface, all.list[one]));
      if (std::isinf(height)) continue;
      for (Index other = 0; other < count; ++other) {
        const double both = all.list[one].half.maxCoeff() + all.list[other].half.maxCoeff();
        if (!(both > height) || all.list[one].piece == all.list[other].piece || !is_base(interface, all.list[other])) continue;
        double& most = allowed[{std::min(one, other), std::max(one, other)}];
        most = std::max(most, both - height);
      }
    }
  }
  return allowed;
}

double audits_due(double every, const State& now) {  // as frames are
  return every > 0 ? std::floor(now.t / every + 1e-9) : static_cast<double>(now.step);
}

bool audit_is_due(double every, const State& now) { return now.audit.looks == 0 || audits_due(every, now) > now.progress.audits; }

void update_overlaps(const Model& model, bool last, double every, State& now, Forces& forces) {
  Progress& progress = now.progress;
  const bool just_looked = now.audit.looks > 0 && progress.audited == now.step && progress.audited_itself == now.step;
  if (last ? just_looked : !audit_is_due(every, now)) return;
  progress.audits = audits_due(every, now), progress.audited = now.step;
  const std::int64_t updates = element_count(model) * (now.step - progress.audited_itself);
  const bool folds = std::any_of(now.quality.begin(), now.quality.end(), [](const Quality& seen) { return seen.inverted; });
  const bool also_itself = last || now.audit.looks == 0 || folds || updates >= updates_per_edge * edges(forces.audit.surfaces);
  if (also_itself) progress.audited_itself = now.step;
  update_thickness(model, now, forces);
  forces.audit.half_growth = forces.half_growth;
  audit::look(now.x, now.t, also_itself, forces.audit, now.audit);
}

bool joins(const contact::AnyContact& any, const audit::Surfaces& all, const audit::Overlap& overlap) {
  if (contact::interface_of(any) == nullptr) return false;
  const contact::Interface& interface = *contact::interface_of(any);
  const Index one = all.list[overlap.surface[0]].piece, other = all.list[overlap.surface[1]].piece;
  return (has_apexes(interface, all, one) && has_base(interface, all, other)) ||
         (has_apexes(interface, all, other) && has_base(interface, all, one));
}

std::string bodies(const audit::Surfaces& all, const audit::Overlap& overlap) {
  const auto [first, second] = std::minmax(overlap.worst.region[0], overlap.worst.region[1]);
  const std::string &one = name(all, first), &other = name(all, second);
  return overlap.surface[0] == overlap.surface[1] || one == other ? one : one + " and " + other;
}

std::string in_words(const audit::Surfaces& all, const audit::Overlap& overlap) {
  const std::string who = bodies(all, overlap);
  const bool two = who.find(' ') != std::string::npos;
  const char* what = overlap.surface[0] == overlap.surface[1] ? " overlaps itself" : two ? " overlap" : ": two parts of it overlap";
  const Vec3& at = overlap.worst.place;
  const std::string said = who + what + formatted(" by %.3g m, %.3g of an element, at (%.4g, %.4g, %.4g) m at %.4g s", overlap.worst.depth,
                                                  audit::in_elements(overlap.worst), at.x(), at.y(), at.z(), overlap.time);
  if (!(overlap.deepest > 1.05 * overlap.worst.depth)) return said;
  return said + formatted(" (and by %.3g m where elements are larger)", overlap.deepest);
}

}  // namespace nereid::dynamics
