#include "model/notes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>

#include "base/words.hpp"
#include "contact/penalty/impact_step.hpp"
#include "dynamics/overlaps.hpp"
#include "dynamics/quality.hpp"
#include "element/width.hpp"
#include "model/advice.hpp"
#include "model/remedies.hpp"

namespace nereid::model {

namespace {

int pairs_that_touch(const contact::Interface& interface) {
  const contact::Bodies& bodies = interface.bodies;
  int count = static_cast<int>(interface.shapes.pairs.size());
  for (Index a = 0; a < bodies.count(); ++a)
    for (Index b = a; b < bodies.count(); ++b) count += bodies.touch[bodies.pair(a, b)] != 0;
  return count;
}

/// The pairs of bodies of an automatic contact that are near each other at the start. Each apex counts for the body of its nearest facet.
std::vector<std::string> pairs_found(const Simulation& simulation, std::size_t c) {
  const auto& interface = std::get<contact::Interface>(simulation.model.contacts[c]);
  const auto& memory = std::get<contact::Memory>(simulation.state.contacts[c]);
  const contact::Bodies& bodies = interface.bodies;
  struct Pair {
    int apexes = 0;
    double least = INFINITY;
  };
  std::map<std::pair<Index, Index>, Pair> found;
  for (const contact::Near& near : memory.near) {
    const Index facet = memory.feature[static_cast<std::size_t>(near.apex)].facet;
    const double gap = memory.gap[static_cast<std::size_t>(near.apex)];
    if (bodies.count() == 0 || facet < 0 || gap < -contact::slight * interface.margin) continue;  // those behind are in no contact
    const Index one = bodies.of_apex[static_cast<std::size_t>(near.apex)], other = bodies.of_facet[static_cast<std::size_t>(facet)];
    const bool beside_it = memory.feature[static_cast<std::size_t>(near.apex)].kind != geometry::Kind::facet;
    if (one == other && beside_it) continue;  // along its own surface, as on any convex body
    Pair& pair = found[{std::min(one, other), std::max(one, other)}];
    ++pair.apexes, pair.least = std::min(pair.least, gap);
  }
  std::vector<std::string> rows;
  for (const auto& [pair, seen] : found) {
    const std::string& one = bodies.names[static_cast<std::size_t>(pair.first)];
    const std::string other = pair.first == pair.second ? "itself" : bodies.names[static_cast<std::size_t>(pair.second)];
    rows.push_back(formatted("%-14s %s and %s: %d apexes within %.4g m, least gap %.4g m", "", one.c_str(), other.c_str(), seen.apexes,
                             interface.margin, seen.least));
  }
  std::set<Index> by_shapes;
  for (const contact::NearFeature& near : memory.near_shapes) by_shapes.insert(near.pair);
  for (const Index p : by_shapes) {
    const contact::ShapePair& pair = interface.shapes.pairs[static_cast<std::size_t>(p)];
    const auto name = [&](Index body) { return bodies.count() > 0 ? bodies.names[static_cast<std::size_t>(body)] : std::string(); };
    if (bodies.count() > 0)
      rows.push_back(formatted("%-14s %s and %s: by the exact shape of %s", "", name(pair.body).c_str(), name(pair.other_body).c_str(),
                               pair.other >= 0 ? "both" : name(pair.body).c_str()));
    else
      rows.push_back(formatted("%-14s by the exact shape of the rigid body%s", "", pair.other >= 0 ? " on each side" : ""));
  }
  if (bodies.count() > 0)
    rows.push_back(formatted("%-14s near each other: %zu of the %d pairs of bodies that may touch", "", found.size() + by_shapes.size(),
                             pairs_that_touch(interface)));
  return rows;
}

/// Overlaps of round-off size with which a contact starts.
std::vector<std::string> slight_overlaps(const Simulation& simulation, std::size_t c) {
  const contact::Sides& both = contact::sides(simulation.model.contacts[c]);
  const bool edges = contact::interface_of(simulation.model.contacts[c]) == nullptr;
  std::vector<std::string> rows;
  for (const contact::SlightOverlap& one : simulation.gaps[c].slight_overlaps) {
    const auto name = [&](Index body) { return both.bodies.names[static_cast<std::size_t>(body)]; };
    const std::string pair = one.apex_body < 0 ? both.name : name(one.apex_body) + " and " + name(one.base_body);
    rows.push_back(formatted("%-14s %s: %d %s overlap at the start, by %.3g m at most, less than %.0e of an element: taken as contact", "",
                             pair.c_str(), one.count, edges ? "pairs of edges" : "apexes", one.deepest, contact::slight));
  }
  return rows;
}

}  // namespace

std::vector<std::string> body_table(const Simulation& simulation) {
  const dynamics::Model& model = simulation.model;
  struct Size {
    std::string name;
    std::size_t nodes = 0;
    std::int64_t elements = 0;
    double mass = 0;
  };
  std::vector<std::vector<Size>> bodies;  // each body with its regions behind it
  for (const element::AnyBlock& block : model.blocks) {
    const std::string& region = element::name(block);
    const std::string body = region.substr(0, region.find('.'));
    auto at = std::find_if(bodies.begin(), bodies.end(), [&](const auto& one) { return one[0].name == body; });
    if (at == bodies.end()) at = bodies.insert(at, {{body, mesh::node_set(model.mesh, body).size()}});
    Scalars mass = Scalars::Zero(model.mesh.X.cols());
    element::add_mass(block, mass);
    const auto nodes = element::nodes(block).reshaped();
    const Size size{region, std::set<Index>(nodes.begin(), nodes.end()).size(), element::tiling(block).elements, mass.sum()};
    (*at)[0].elements += size.elements, (*at)[0].mass += size.mass;
    at->push_back(size);
  }
  for (std::vector<Size>& body : bodies)
    for (const rigid::Body& rigid : model.rigid_bodies)
      if (rigid.name == body[0].name) body[0].mass = rigid.mass.mass;  // which may be given
  std::vector<std::string> table{"bodies                     nodes   elements  mass [kg]"};
  const auto add = [&](const std::string& name, const Size& size) {
    table.push_back(formatted("%-22s %9zu  %9lld  %.6g", name.c_str(), size.nodes, static_cast<long long>(size.elements), size.mass));
  };
  for (const std::vector<Size>& body : bodies) {
    add(body[0].name, body[0]);
    if (body.size() == 2 && body[1].name == body[0].name) continue;
    for (std::size_t r = 1; r < body.size(); ++r) add("  " + body[r].name.substr(body[0].name.size()), body[r]);
  }
  return table;
}

std::vector<std::string> gap_table(const Simulation& simulation) {
  std::vector<std::string> table;
  if (simulation.gaps.empty()) return table;
  table.push_back("initial gaps   apexes  on facet  on edge  on vertex  no base  penetrating  least [m]    mean [m]     largest [m]");
  for (std::size_t c = 0; c < simulation.gaps.size(); ++c) {
    const contact::InitialGaps& g = simulation.gaps[c];
    if (const auto* edges = std::get_if<contact::EdgeContact>(&simulation.model.contacts[c])) {
      table.push_back(formatted("%-14s %d and %d edges, %d pairs within %.4g m, %d of them penetrating", edges->name.c_str(),
                                static_cast<int>(edges->edges.nodes.cols()), static_cast<int>(edges->base_edges.nodes.cols()),
                                g.pairs, edges->margin, g.penetrating));
      for (const std::string& row : slight_overlaps(simulation, c)) table.push_back(row);
      continue;
    }
    const auto& interface = std::get<contact::Interface>(simulation.model.contacts[c]);
    const bool any = g.apexes > g.without_base + g.behind;
    const bool overlaps = g.penetrating > 0 || !g.slight_overlaps.empty() || interface.kind == contact::InterfaceKind::tied;
    const auto shown = [&](double gap) { return overlaps ? gap : std::max(gap, 0.0); };  // without round-off
    const std::string gaps = any ? formatted("%-11.4g  %-11.4g  %-11.4g", shown(g.least), shown(g.mean), shown(g.largest))
                                 : "-            -            -";
    table.push_back(formatted("%-14s %6d  %8d  %7d  %9d  %7d  %11d  ", interface.name.c_str(), g.apexes, g.by_kind[3], g.by_kind[2],
                              g.by_kind[1], g.without_base, g.penetrating) + gaps);
    if (g.behind > 0)
      table.push_back(formatted("%-14s %d of %d apexes are behind the base and not in contact, as below a table", "", g.behind,
                                g.apexes));
    for (const std::string& pair : pairs_found(simulation, c)) table.push_back(pair);
    for (const std::string& row : slight_overlaps(simulation, c)) table.push_back(row);
    if (!contact::by_multipliers(interface) && interface.bodies.count() == 0)
      table.push_back(formatted("%-14s penalty %.4g Pa/m", "", interface.penalty));
    if (g.free > 0)
      table.push_back(formatted("%-14s %d of %d apexes are free: they are beyond the border of the base or have no base", "", g.free,
                                g.apexes));
  }
  return table;
}

std::vector<std::string> width_notes(const Simulation& simulation) {
  constexpr double worth_saying = 2;  // [-] a brick twice as long as wide and high stays unmentioned
  std::vector<std::string> notes;
  constexpr double near = 2;  // [-] bodies whose elements allow steps longer than by this limit nothing
  const dynamics::Model& model = simulation.model;
  std::vector<element::Narrowest> of_blocks;
  double fastest = 0;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const bool moves_as_one = dynamics::is_rigid_block(model, b);  // whose elements limit no step
    of_blocks.push_back(moves_as_one ? element::Narrowest{} : element::narrowest(model.blocks[b], simulation.state.x));
    fastest = std::max(fastest, of_blocks.back().frequency);
  }
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const auto& block = model.blocks[b];
    const element::Narrowest& at = of_blocks[b];
    if (at.gain < worth_saying || near * at.frequency < fastest) continue;
    notes.push_back(formatted("%s: its step is limited by element %d at (%.4g, %.4g, %.4g) m, which is %.3g m wide along "
                              "(%.3g, %.3g, %.3g) and %.3g m across; this width makes the step %.3g times smaller",
                              element::name(block).c_str(), at.element, at.centre.x(), at.centre.y(), at.centre.z(), at.width(0),
                              at.direction.x(), at.direction.y(), at.direction.z(), at.width(1), at.gain));
  }
  return notes;
}

namespace {

/// Whether each node is one of a fluid.
std::vector<char> nodes_of_fluids(const dynamics::Model& model) {
  std::vector<char> is(static_cast<std::size_t>(model.mesh.X.cols()), 0);
  for (const element::AnyBlock& any : model.blocks)
    std::visit(
        [&]<class Kind, class Law>(const element::Block<Kind, Law>& block) {
          if constexpr (std::is_same_v<Kind, element::Fluid>)
            for (const Index node : block.nodes.reshaped()) is[static_cast<std::size_t>(node)] = 1;
        },
        any);
  return is;
}

}  // namespace

std::vector<std::string> coarseness_notes(const Simulation& simulation) {
  constexpr double worth_saying = 1.25 - 1e-6;  // [-] up to 1.2 exchanged sides err as much: docs/contact_methods.md
  std::vector<std::string> notes;
  const load::Memory& constraints = simulation.state.constraints;
  const auto held = [&](Index node) {
    if (dynamics::is_rigid_node(simulation.model, node)) return true;
    const Index row = constraints.row_of_node[node];
    return row >= 0 && constraints.nodes[row].allowed.isZero(0);
  };
  const std::vector<char> is_of_fluid = nodes_of_fluids(simulation.model);
  const auto of_fluid = [&](Index node) { return is_of_fluid[static_cast<std::size_t>(node)] != 0; };
  for (std::size_t c = 0; c < simulation.gaps.size(); ++c) {
    const contact::Coarseness& seen = simulation.gaps[c].coarseness;
    if (!(seen.apexes >= worth_saying)) continue;
    const auto& interface = std::get<contact::Interface>(simulation.model.contacts[c]);
    if (std::all_of(interface.base_nodes.begin(), interface.base_nodes.end(), held)) continue;  // a base that cannot give way
    // fluids were seen to lose nothing by it, and to be locked by two passes: docs/slug_impact.md
    if (std::any_of(interface.apexes.begin(), interface.apexes.end(), of_fluid)) continue;
    const bool tied = interface.kind == contact::InterfaceKind::tied;  // which has one pass
    const std::string instead = seen.base >= worth_saying ? said(tied ? Remedy::refine_apexes : Remedy::two_passes)
                                : tied                  ? said(Remedy::exchange_sides)
                                                          : said(Remedy::exchange_sides) + ", or " + said(Remedy::two_passes);
    const bool over_points = interface.heights == contact::Heights::points;
    notes.push_back(formatted("%s: its apexes are %.3g times as far apart as the nodes of its base, so that %s: %s", interface.name.c_str(),
                              seen.apexes,
                              over_points ? "the stress beside the interface is wrong by up to 10 %"
                                          : "nodes of the base between them are not held and the stress beside the interface is wrong by 2 "
                                            "to 150 %",
                              instead.c_str()));
  }
  return notes;
}

std::vector<std::string> rounding_notes(const Simulation& simulation) {
  constexpr double worth_saying = 1e-12;  // [-] of an element: impacts that chatter have been seen to multiply it by 3e9
  constexpr double far_away = 10;         // [-] times the size of the body
  const audit::Surface* worst = nullptr;
  double most = 0, rounding = 0;
  for (const audit::Surface& surface : simulation.forces.audit.surfaces.list) {
    Vec3 low = Vec3::Constant(INFINITY), high = -low;
    for (const Index n : surface.nodes) low = low.cwiseMin(simulation.state.x.col(n)), high = high.cwiseMax(simulation.state.x.col(n));
    const double from_origin = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
    if (!(from_origin > far_away * (high - low).maxCoeff()) || !std::isfinite(from_origin)) continue;  // to move it would not help
    const double here = 0.5 * std::numeric_limits<double>::epsilon() * from_origin;
    if (here / surface.smallest > most) worst = &surface, most = here / surface.smallest, rounding = here;
  }
  if (worst == nullptr || !(most > worth_saying)) return {};
  return {formatted("%s: this far from the origin, positions are rounded by %.2g m, %.2g of an element, and contact magnifies this: %s",
                    simulation.forces.audit.surfaces.names[static_cast<std::size_t>(worst->face_region[0])].c_str(), rounding, most,
                    words(Remedy::near_origin).words)};
}

std::vector<std::string> depth_notes(const Simulation& simulation) {
  std::vector<std::string> notes;
  const auto look = [&notes](const auto& contact, double element, const auto& memory, Index node, bool may_have_multipliers) {
    if (!(element > 0 && memory.deepest > (0.5 + 1e-6) * element)) return;  // more than round-off beyond
    const bool soft = !contact::by_multipliers(contact);
    notes.push_back(formatted("%s: node %d had a penetration of %.3g m, %.3g of the depth of an element, at %.8g s: %sthe approach is "
                              "too fast",
                              contact.name.c_str(), node, memory.deepest, memory.deepest / element, memory.deepest_time,
                              soft ? "the penalty is too soft or " : "") +
                    (soft && may_have_multipliers ? "; " + said(Remedy::firmer_contact) : ""));
  };
  const dynamics::Model& model = simulation.model;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const contact::SidesMemory& memory = contact::sides(simulation.state.contacts[c]);
    const contact::Interface* interface = contact::interface_of(model.contacts[c]);
    const bool may_have_multipliers = interface == nullptr || model::may_have_multipliers(model, *interface);
    const auto look_at = [&](const auto& one) { look(one, memory.deepest_in, memory, memory.deepest_apex, may_have_multipliers); };
    std::visit(look_at, model.contacts[c]);
  }
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) {
    const auto& memory = simulation.state.rigid_planes[p];
    look(model.rigid_planes[p], model.rigid_planes[p].depth, memory, memory.deepest_node, true);
  }
  return notes;
}

std::vector<std::string> overlap_notes(const Simulation& simulation) {
  constexpr double worth_saying = 0.1;  // [-] of an element
  constexpr std::size_t most = 8;       // said one by one
  std::vector<std::string> notes;
  std::size_t more = 0;
  const audit::Surfaces& surfaces = simulation.forces.audit.surfaces;
  const auto& contacts = simulation.model.contacts;
  for (const audit::Overlap& overlap : simulation.state.audit.overlaps) {
    bool joined = false, expected = false;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (!dynamics::joins(contacts[c], surfaces, overlap)) continue;
      joined = true;
      const bool tied = contact::interface_of(contacts[c])->kind == contact::InterfaceKind::tied;
      expected = expected || tied || simulation.gaps[c].penetrating > 0;
    }
    const bool from_start = overlap.at_start - overlap.allowed > worth_saying * overlap.worst.size && !expected;
    if (!(overlap.grown > worth_saying) && !from_start) continue;
    if (notes.size() == most) {
      ++more;
      continue;
    }
    std::string note = dynamics::in_words(surfaces, overlap);
    if (overlap.at_start > 0) note += formatted(", and by %.3g m at the start", overlap.at_start);
    if (!joined) note += "; " + said(Remedy::declare_contact);
    notes.push_back(note);
  }
  if (more > 0) notes.push_back(formatted("summary.json lists %zu more overlaps of bodies", more));
  return notes;
}

namespace {

/// Whether a force, a spring or a point mass acts on a single node of these elements.
bool has_force_on_a_node(const Simulation& simulation, const element::Connectivity& elements) {
  Subset single;
  const auto add = [&single](const Subset& nodes) {
    if (nodes.size() == 1) single.push_back(nodes[0]);
  };
  for (const load::AnyLoad& any : simulation.model.loads)
    if (const auto* force = std::get_if<load::NodalForce>(&any)) add(force->nodes);
    else if (const auto* spring = std::get_if<load::Spring>(&any)) add({spring->from}), add({spring->to});
  for (const load::PointMass& mass : simulation.model.point_masses) add(mass.nodes);
  const auto all = elements.reshaped();
  return std::any_of(all.begin(), all.end(), [&](Index node) { return std::find(single.begin(), single.end(), node) != single.end(); });
}

/// Whether its elements resist hourglassing by springs or dashpots.
bool has_springs_or_dashpots(const element::AnyBlock& any) {
  return std::visit(
      []<class Kind, class Law>(const element::Block<Kind, Law>& block) {
        if constexpr (requires { block.options.hourglass_kind; }) return block.options.hourglass_kind != Kind::Hourglass::assumed_strain;
        return false;
      },
      any);
}

constexpr double springs_worth_a_warning = 0.1;  // [-] the usual bound on hourglass energy

/// Hourglass energy of springs or dashpots over the internal energy of a block; zero of other blocks. [-]
double by_springs(const Simulation& simulation, std::size_t b) {
  if (!has_springs_or_dashpots(simulation.model.blocks[b])) return 0;
  const dynamics::Quality& seen = simulation.state.quality[b];
  return dynamics::of_internal(seen, seen.hourglass, dynamics::energy_of_scene(simulation.state.ledger));
}

// Limits by scripts/coarse: docs/coarse_meshes.md.
constexpr double bending_worth_a_note = 0.018;          // [-]
constexpr double concentration_worth_a_warning = 0.17;  // [-] where bodies flow
constexpr double flow = 0.01;                           // [-] of the energy of the scene, dissipated by plasticity
constexpr double nodes_worth_no_note = 4;               // [-]
constexpr double plates_worth_a_note = 0.01;            // [-] of the energy of the scene
constexpr double viscous_worth_a_note = 0.1;            // [-] likewise; a twentieth of the speed
constexpr double of_noted = 45, of_warned = 80;         // [%] that change by more than 5 % on a mesh twice as fine

/// The block that has most of a part of the contrast, as a place in Model::blocks.
template <class Part>
std::size_t most_unlike(const Simulation& simulation, Part&& part) {
  const auto& seen = simulation.state.quality;
  const auto less = [&](const auto& one, const auto& other) { return part(one.contrast) < part(other.contrast); };
  return static_cast<std::size_t>(std::max_element(seen.begin(), seen.end(), less) - seen.begin());
}

/// What the strain energy of a scene is concentrated in.
struct Concentrated {
  double part = 0;        ///< [-] of it; zero where that is no error: what elastic bodies concentrate they give back
  std::size_t block = 0;  ///< that has most of it
  bool pricked = false;   ///< by a force on a single node, which has no limit on finer meshes
};
Concentrated concentrated(const Simulation& simulation) {
  Concentrated found;
  found.block = most_unlike(simulation, [](const element::Contrast& one) { return one.density; });
  if (found.block >= simulation.model.blocks.size()) return found;
  found.pricked = has_force_on_a_node(simulation, element::nodes(simulation.model.blocks[found.block]));
  const bool flows = dynamics::dissipated_share(simulation.state.ledger, Dissipated::plastic) > flow;
  if (flows || found.pricked) found.part = dynamics::contrast(simulation.state).density;
  return found;
}

/// Contacts and rigid planes with restitution, by multipliers, that passed energy on in a scene whose bodies flowed.
std::vector<std::string> contacts_that_give_back(const Simulation& simulation) {
  constexpr double flows = 0.2;  // [-] of the energy of the scene, dissipated by plasticity
  const dynamics::Model& model = simulation.model;
  const dynamics::Ledger& ledger = simulation.state.ledger;
  std::vector<std::string> names;
  if (!(dynamics::dissipated_share(ledger, Dissipated::plastic) > flows)) return names;
  const std::vector<Source> all = dynamics::sources(model);
  const auto has_passed = [&](const std::string& name) {
    for (std::size_t s = 0; s < all.size(); ++s)
      if (all[s].name == name && ledger.flows[s].passed > 0) return true;
    return false;
  };
  const auto look = [&](const auto& one) {
    if (contact::by_multipliers(one) && one.restitution > 0 && has_passed(one.name)) names.push_back(one.name);
  };
  for (const contact::AnyContact& any : model.contacts)
    if (const contact::Interface* interface = contact::interface_of(any); interface != nullptr && !contact::follows(any))
      if (interface->kind != contact::InterfaceKind::tied) look(*interface);
  for (const auto& plane : model.rigid_planes) look(plane);
  return names;
}

bool is_fluid(const element::AnyBlock& any) {
  return std::visit([]<class Kind, class Law>(const element::Block<Kind, Law>&) { return std::is_same_v<Kind, element::Fluid>; }, any);
}

/// Whether the largest value of a probe is larger than the mean of the same elements: that of an even field follows no mesh.
bool is_uneven(const dynamics::Probe& probe, const Simulation& simulation) {
  constexpr double even = 1.02;  // [-] of the mean
  const dynamics::View view{simulation.model, simulation.state, simulation.forces, false};
  dynamics::Kept kept;
  return probe.value(view, kept) > even * probe.mean(view, kept);
}

}  // namespace

std::vector<std::string> quality_notes(const Simulation& simulation) {
  constexpr double thickness_worth_saying = 1.05;  // [-] a bar has that at a plastic strain of a tenth
  constexpr double control_worth_saying = 0.01;    // [-] of the internal energy, in distortion control
  constexpr double pressed_worth_saying = 0.5;     // [-] of Young's modulus: vibrations grow from there on, surfaces fold at 0.61
  constexpr double spin_worth_saying = 0.01;       // [-] of the energy of the scene
  std::vector<std::string> notes;
  const double scale = dynamics::energy_of_scene(simulation.state.ledger);
  for (std::size_t b = 0; b < simulation.model.blocks.size(); ++b) {
    const dynamics::Quality& seen = simulation.state.quality[b];
    const char* name = element::name(simulation.model.blocks[b]).c_str();
    const bool pricked = has_force_on_a_node(simulation, element::nodes(simulation.model.blocks[b]));
    if (!(seen.corner > 0) && seen.element >= 0)
      notes.push_back(formatted("%s: a corner of element %d was inverted, its Jacobian %.3g of the reference at %.4g s", name, seen.element,
                                seen.corner, seen.time) +
                      (pricked ? ": " + said(Remedy::spread_force) : ""));
    if (std::abs(std::log(seen.thinned.ratio)) > std::log(thickness_worth_saying))
      notes.push_back(formatted("%s: plates keep their thickness, but with the strain of element %d it would be %.3g of the initial one at "
                                "%.4g s: the forces of the element are wrong by this factor; %s",
                                name, seen.thinned.element, seen.thinned.ratio, seen.thinned_at, words(Remedy::follow_strain).words));
    if (scale > 0 && seen.spin.energy > spin_worth_saying * scale)
      notes.push_back(formatted("%s: the spin of nodes about their normals, fastest at node %d, had %.3g of the energy of the scene at "
                                "%.4g s; with 'drilling: 0' plates have no stiffness against it; %s",
                                name, seen.spin.node, seen.spin.energy / scale, seen.spin.time, words(Remedy::drilling).words));
    const auto of_internal = [&](double energy) { return dynamics::of_internal(seen, energy, scale); };
    if (of_internal(seen.distortion) > control_worth_saying)
      notes.push_back(formatted("%s: the energy of distortion control reached %.3g of the internal energy (limit %.3g): the shape of "
                                "elements whose corners close depends on it", name, of_internal(seen.distortion), control_worth_saying) +
                      (pricked ? ": " + said(Remedy::spread_force) : ""));
    if (seen.pressed.ratio > pressed_worth_saying)
      notes.push_back(formatted("%s: element %d was pressed by %.3g of Young's modulus at %.4g s; beyond %.3g a hypoelastic law is "
                                "unstable: ", name, seen.pressed.element, seen.pressed.ratio, seen.pressed_at, pressed_worth_saying) +
                      said(Remedy::neo_hookean));
    if (const double part = by_springs(simulation, b); part > springs_worth_a_warning)
      notes.push_back(formatted("%s: hourglass energy reached %.3g of the internal energy: ", name, part) + said(Remedy::assumed_strain));
  }
  return notes;
}

std::vector<std::string> mesh_warnings(const Simulation& simulation) {
  std::vector<std::string> notes;
  if (const Concentrated seen = concentrated(simulation); seen.part > concentration_worth_a_warning) {
    const std::string single = formatted("%.3g of the strain energy of all solids is concentrated in single elements, most of it in this "
                                         "body (limit %.3g)", seen.part, concentration_worth_a_warning);
    const std::string rate = formatted("; in tests with 2 to 4 elements a side, %.2g %% of such runs changed by more than 5 %% on a mesh "
                                       "twice as fine: ", of_warned);
    notes.push_back(element::name(simulation.model.blocks[seen.block]) + ": " +
                    (seen.pricked ? single + ": " + said(Remedy::spread_force)
                                  : "bodies of the scene deform plastically, and " + single + rate + said(Remedy::finer_mesh)));
  }
  return notes;
}

std::vector<std::string> curve_notes(const Simulation& simulation) {
  std::vector<std::string> notes;
  for (std::size_t b = 0; b < simulation.model.blocks.size(); ++b) {
    const element::AnyBlock& any = simulation.model.blocks[b];
    double last = std::numeric_limits<double>::infinity();  // of the shortest of its curves
    std::visit(
        [&last]<class Kind, class Law>(const element::Block<Kind, Law>& block) {
          if constexpr (std::is_same_v<Law, material::J2Curve>)
            for (const material::MeasuredCurve& curve : block.law.flow.curves) last = std::min(last, curve.strain.back());
        },
        any);
    if (!std::isfinite(last) || dynamics::is_rigid_block(simulation.model, b)) continue;
    double most = 0;
    const auto look = [&](element::Place place) {
      most = std::max(most, dynamics::of_body(view(simulation), {b}, {"plastic_strain", place}, 0, dynamics::Take::largest));
    };
    if (element::rotates(any)) look(element::Place::top), look(element::Place::bottom);
    else look(element::Place::none);
    if (most > last)
      notes.push_back(formatted("%s: the plastic strain reached %.3g, and the hardening curve ends at %.3g: beyond its last point the flow "
                                "stress is constant", element::name(any).c_str(), most, last));
  }
  return notes;
}

std::vector<std::string> formula_notes(const Simulation& simulation) {
  std::vector<std::string> notes;
  for (std::size_t p = 0; p < simulation.probes.size() && p < simulation.state.probes.size(); ++p)
    if (const dynamics::ProbeMemory& memory = simulation.state.probes[p]; memory.not_finite > 0)
      notes.push_back(formatted("probe '%s': the formula was no finite number in %lld of %lld steps, as by a division by zero; these are "
                                "not in its extremes", simulation.probes[p].name.c_str(), static_cast<long long>(memory.not_finite),
                                static_cast<long long>(memory.samples)));
  return notes;
}

std::vector<std::string> mesh_notes(const Simulation& simulation) {
  std::vector<std::string> notes;
  const dynamics::Model& model = simulation.model;
  const dynamics::State& now = simulation.state;
  const element::Contrast all = dynamics::contrast(now);
  bool warned = concentrated(simulation).part > concentration_worth_a_warning;  // which says more
  for (std::size_t b = 0; b < model.blocks.size(); ++b) warned = warned || by_springs(simulation, b) > springs_worth_a_warning;
  const std::string then = formatted(": one run cannot estimate the error of its mesh; in tests with 2 to 4 elements a side, %.2g %% of "
                                     "such runs changed by more than 5 %% on a mesh twice as fine: ", of_noted) +
                           said(Remedy::estimate_error);
  if (!warned && all.bending > bending_worth_a_note) {
    const std::size_t b = most_unlike(simulation, [](const element::Contrast& one) { return one.bending; });
    notes.push_back(formatted("%s: hourglass energy above that of the neighbours is %.3g of the strain energy of all solids, most of it "
                              "in this body (limit %.3g)",
                              element::name(model.blocks[b]).c_str(), all.bending, bending_worth_a_note) +
                    then);
  }
  const double scale = dynamics::energy_of_scene(now.ledger);
  double viscous = 0;  // [J] of solids and plates: shocks in fluids dissipate
  for (std::size_t b = 0; b < model.blocks.size(); ++b)
    if (!is_fluid(model.blocks[b])) viscous += now.ledger.accounts[b].dissipated[Dissipated::viscous];
  if (scale > 0 && viscous > viscous_worth_a_note * scale)
    notes.push_back(formatted("the viscosity of shocks dissipated %.2g of the energy of the scene in solids and plates: on this mesh "
                              "waves are as short as its elements: ", viscous / scale) + said(Remedy::estimate_error));
  std::vector<std::string> plates, plastic, of_one_point;  // names
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const dynamics::Quality& seen = now.quality[b];
    const bool deforms = element::rotates(model.blocks[b]) && !dynamics::is_rigid_block(model, b);
    if (!deforms || !(seen.internal > plates_worth_a_note * scale)) continue;
    plates.push_back(element::name(model.blocks[b]) + formatted(" (artificial modes %.2g of its internal energy)",
                                                                dynamics::of_internal(seen, seen.artificial, scale)));
  }
  if (!plates.empty())
    notes.push_back(joined(plates) + ": one run cannot estimate the error of a mesh of plates: " + said(Remedy::estimate_error));
  for (std::size_t p = 0; p < simulation.probes.size() && p < now.probes.size(); ++p) {
    const dynamics::Probe& probe = simulation.probes[p];
    if (probe.follows_mesh != dynamics::FollowsMesh::no && now.probes[p].largest > 0 && is_uneven(probe, simulation))
      (probe.follows_mesh == dynamics::FollowsMesh::yes ? plastic : of_one_point).push_back(probe.name);
    if (probe.footing < 0 || static_cast<std::size_t>(probe.footing) >= now.footings.size()) continue;
    const double nodes = now.footings[static_cast<std::size_t>(probe.footing)].nodes;
    if (nodes > 0 && nodes < nodes_worth_no_note) {
      const std::string few = formatted("%.2g", nodes);
      notes.push_back(formatted("%s: the largest force of this contact acted on %s node%s (fewer than %g), and such a peak depends on "
                                "the mesh: ", probe.name.c_str(), few.c_str(), few == "1" ? "" : "s", nodes_worth_no_note) +
                      said(Remedy::estimate_error));
    }
  }
  const char* follows = ": the largest plastic strain depends on the mesh: ";
  if (!of_one_point.empty()) notes.push_back(joined(of_one_point) + follows + said(Remedy::eight_points));
  if (!plastic.empty()) notes.push_back(joined(plastic) + follows + said(Remedy::estimate_error));
  if (const std::vector<std::string> give_back = contacts_that_give_back(simulation); !give_back.empty())
    notes.push_back(joined(give_back) + ": bodies of the scene deform plastically, and 'restitution' returns the energy that a layer of "
                                        "elements loses at first touch, which is more than metal returns: docs/scene.md");
  return notes;
}

namespace {

/// What a contact holds of the energy that it took, and between bodies that do not touch at the end. [J]
struct Held {
  std::string contact;
  double open = 0, passed = 0;
};

/// The name of a contact, whatever pass or edges of it this is.
std::string contact_of(const contact::AnyContact& contact) {
  std::string name = contact::sides(contact).name;
  for (const std::string part : {"_edges", "_back"})
    if (name.ends_with(part)) name.resize(name.size() - part.size());
  return name;
}

/// [J] held by the bodies of a pair, -1 for both sides of a declared contact; infinity where an apex or edge of them touches.
using HeldByPairs = std::map<std::pair<Index, Index>, double>;
void add_pair(Index one, Index other, bool touches, double energy, HeldByPairs& held) {
  held[std::minmax(one, other)] += touches ? INFINITY : std::max(0.0, energy);
}

/// Adds up what apexes hold.
void add_held(const contact::Interface& interface, const contact::Memory& memory, HeldByPairs& held) {
  const contact::Bodies& bodies = interface.bodies;
  for (const contact::Near& near : memory.near) {
    const auto apex = static_cast<std::size_t>(near.apex);
    const Index facet = memory.feature[apex].facet;
    const bool has_pair = bodies.count() > 0 && facet >= 0;
    add_pair(has_pair ? bodies.of_apex[apex] : -1, has_pair ? bodies.of_facet[static_cast<std::size_t>(facet)] : -1, near.element.closed,
             memory.restitution[apex].held, held);
  }
}

/// The same of edges.
void add_held(const contact::EdgeContact& contact, const contact::EdgeMemory& memory, HeldByPairs& held) {
  const contact::Bodies& bodies = contact.bodies;
  for (const contact::Crossing& crossing : memory.crossings) {
    const bool has_pair = bodies.count() > 0;
    const auto body = [&](std::size_t node) { return has_pair ? bodies.of_node[static_cast<std::size_t>(crossing.node[node])] : -1; };
    add_pair(body(0), body(2), crossing.closed, crossing.restitution.held, held);
  }
}

/// What contacts by multipliers hold between bodies that do not touch.
std::vector<Held> held_by_open_contacts(const Simulation& simulation) {
  const dynamics::Model& model = simulation.model;
  const std::vector<Source> all = dynamics::sources(model);
  const auto passed = [&](const std::string& name) {
    for (std::size_t s = 0; s < all.size(); ++s)
      if (all[s].name == name) return simulation.state.ledger.flows[s].passed;
    return 0.0;
  };
  std::map<std::string, HeldByPairs> of_contacts;
  std::map<std::string, double> passed_through;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const contact::AnyContact& any = model.contacts[c];
    if (!contact::by_multipliers(any) || contact::tied_by_multipliers(any)) continue;
    contact::with_memory(any, simulation.state.contacts[c],
                         [&](const auto& one, const auto& memory) { add_held(one, memory, of_contacts[contact_of(any)]); });
    passed_through[contact_of(any)] += passed(contact::sides(any).name);
  }
  std::vector<Held> found;
  for (const auto& [contact, pairs] : of_contacts) {
    Held& one = found.emplace_back(contact, 0, passed_through[contact]);
    for (const auto& [pair, energy] : pairs)
      if (energy < INFINITY) one.open += energy;
  }
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) {
    const contact::PlaneMemory& memory = simulation.state.rigid_planes[p];
    if (!contact::by_multipliers(model.rigid_planes[p])) continue;
    if (std::any_of(memory.force.begin(), memory.force.end(), [](double force) { return force > 0; })) continue;
    Held& one = found.emplace_back(model.rigid_planes[p].name, 0, passed(model.rigid_planes[p].name));
    for (const contact::Restitution& node : memory.restitution) one.open += std::max(0.0, node.held);
  }
  return found;
}

}  // namespace

std::vector<std::string> energy_notes(const Simulation& simulation) {
  constexpr double worth_a_warning = 0.2;  // of the limit: a hundredth of the energy by default
  const double limit = simulation.time.created_limit;
  std::vector<std::string> notes;
  const dynamics::Ledger& ledger = simulation.state.ledger;
  const double scene = dynamics::energy_scale(ledger);
  const auto look = [&](const std::string& name, double part, double share, const std::string& of, double stops) {
    if (!(std::abs(part) > worth_a_warning * limit)) return;
    notes.push_back(name + ": " + (part > 0 ? "created " : "lost ") + percent(share) + " of the energy " + of + ", at worst" +
                    (share < stops ? "; a run stops at " + percent(stops) : ""));  // of little, more than that stops none
  };
  const std::string of_scene = formatted("of the scene, %.2g J", scene);
  const std::vector<Source> all = dynamics::sources(simulation.model);
  for (std::size_t s = 0; s < all.size(); ++s) {
    const double stops = limit * dynamics::times_the_limit(simulation.model, ledger, static_cast<int>(s));
    const dynamics::Created& told = ledger.flows[s].told;
    const double made = std::abs(told.energy), of_all = ledger.flows[s].worst_of_scene;
    look(all[s].name, told.part, made / told.passed,
         formatted("that it transferred, %.2g J of %.2g J, which is ", made, told.passed) + percent(made / scene) +
             " of the energy of the scene",
         stops);
    look(all[s].name, of_all, std::abs(of_all), of_scene, limit);
  }
  look("time integration", ledger.worst_kept, std::abs(ledger.worst_kept), of_scene, limit);
  const double swing = dynamics::swing_part(ledger);
  if (swing > limit && !(std::abs(ledger.worst_kept) > worth_a_warning * limit))  // one of both is said; what swings comes back
    notes.push_back("time integration: the staggering error of the kinetic energy reached " + percent(swing) + " of the energy " +
                    of_scene + ", and did not last; " + said(Remedy::shorter_step));
  for (const Held& held : held_by_open_contacts(simulation))
    if (held.open > worth_a_warning * limit * held.passed && held.open > dynamics::least_share * scene)
      notes.push_back(formatted("%s: its bodies do not touch at the end, and the contact still holds %.2g J of the %.2g J that it "
                                "transferred, ",
                                held.contact.c_str(), held.open, held.passed) +
                      percent(held.open / held.passed) + ": they separate too slowly");
  return notes;
}

std::vector<std::string> step_notes(const Simulation& simulation) {
  std::vector<std::string> notes;
  const auto look = [&notes](const auto& contact, const contact::StepFactorMemory& memory) {
    if (memory.lowered_at < 0) return;
    notes.push_back(formatted("%s: created or lost more than %s of the energy that it transferred, so its steps "
                              "are %.3g times shorter from %.6g s on",
                              contact.name.c_str(), percent(contact::most_created_in_a_bounce(contact.impact_step_factor)).c_str(),
                              contact.first_step_factor / contact.impact_step_factor, memory.lowered_at));
  };
  const dynamics::Model& model = simulation.model;
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (const contact::Interface* interface = contact::interface_of(model.contacts[c]))
      look(*interface, std::get<contact::Memory>(simulation.state.contacts[c]).step_factor);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) look(model.rigid_planes[p], simulation.state.rigid_planes[p].step_factor);
  return notes;
}

std::string energy_line(const Simulation& simulation) {
  const dynamics::Ledger& ledger = simulation.state.ledger;
  double outside = 0, stored = dynamics::initial_stored(ledger), dissipated = 0, created = 0;
  for (const Account& account : ledger.accounts) {
    const double given = account.stored[Stored::external_work] + account.stored[Stored::potential];
    outside -= given;
    stored += dynamics::stored(account) - given;
    dissipated += dynamics::dissipated(account);
    created += dynamics::created(account) - dynamics::overdrawn(account);
  }
  return formatted("energy: %.4g J at the start and %.4g J of external work became %.4g J kinetic, %.4g J stored, %.4g J dissipated; "
                   "created %.2g J, time integration %.2g J",
                   ledger.initial_kinetic + dynamics::initial_stored(ledger), outside, ledger.kinetic, stored, dissipated, created,
                   ledger.integration);
}

std::int64_t count_elements(const dynamics::Model& model) {
  std::int64_t sum = 0;
  for (const auto& block : model.blocks) sum += element::tiling(block).elements;
  return sum;
}

}  // namespace nereid::model
