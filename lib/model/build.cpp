#include "model/build.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "base/check.hpp"
#include "base/memory.hpp"
#include "base/words.hpp"
#include "dynamics/automatic.hpp"
#include "dynamics/section.hpp"
#include "mesh/adjacency.hpp"
#include "model/actions.hpp"
#include "model/meshes.hpp"
#include "model/names.hpp"
#include "model/probes.hpp"
#include "model/rigid_bodies.hpp"
#include "model/sets.hpp"
#include "model/stages.hpp"
#include "model/stops.hpp"
#include "model/values.hpp"

namespace nereid::model {

namespace {

using Names = std::vector<std::string>;

template <class... Lists>
Names names_of(const Lists&... lists) {
  Names names;
  const auto add = [&names](const auto& all) {
    for (const auto& one : all) names.push_back(one.name);
  };
  (add(lists), ...);
  return names;
}

void check_probes(const Scene& scene, const mesh::Mesh& mesh, Faults& faults) {
  Names regions = names_of(scene.bodies), quantities;
  for (const Body& body : scene.bodies)
    for (const Set& set : body.sets)
      if (has_elements(body, set.name)) regions.push_back(body.name + "." + set.name);
  for (const std::string& name : names_of(mesh.hexahedra, mesh.triangles))
    if (name.find('.') != std::string::npos) regions.push_back(name);
  const Names sets = names_of(mesh.node_sets), contacts = names_of(scene.contacts);
  const Names sources = names_of(scene.contacts, scene.planes, scene.rigid_planes, scene.loads, scene.springs, scene.sections);
  for (const Measurable& one : measurables()) quantities.push_back(one.name);
  for (const Probe& probe : scene.probes) {
    const Part here = part("probe", probe);
    if (probe.formula.value) continue;
    expect(faults, here, "quantity", probe.quantity, "quantities", quantities);
    const Measurable* quantity = find_measurable(probe.quantity);
    if (quantity == nullptr) continue;
    switch (quantity->of) {
      case Of::nodes:
        expect(faults, here, "of", probe.of, "node sets", sets);
        for (const mesh::NodeSet& set : mesh.node_sets)
          if (set.name == probe.of && set.nodes.empty()) refuse(faults, here, "of", "'of' = " + probe.of + " has no nodes");
        break;
      case Of::body: expect(faults, here, "of", probe.of, "bodies, regions and sets with elements", regions); break;
      case Of::contact: expect(faults, here, "of", probe.of, "contacts", contacts); break;
      case Of::any_contact:
        expect(faults, here, "of", probe.of, "contacts", names_of(scene.contacts, scene.automatic_contacts));
        break;
      case Of::source:
        if (probe.between[0].empty()) {
          if (has(names_of(scene.automatic_contacts), probe.of))
            refuse(faults, here, "of", "'of' = " + probe.of + " is an automatic contact: 'between: [BODY, BODY]' says which two bodies");
          else expect(faults, here, "of", probe.of, "contacts, planes, loads, springs and sections", sources);
          break;
        }
        if (has(sources, probe.of))
          refuse(faults, here, "between", "'between' is for automatic contacts: leave it out for " + probe.of);
        else expect(faults, here, "of", probe.of, "automatic contacts", names_of(scene.automatic_contacts));
        for (std::size_t i = 0; i < 2; ++i)
          expect(faults, here, "between[" + std::to_string(i) + "]", probe.between[i], "bodies", names_of(scene.bodies));
        if (probe.between[0] == probe.between[1])
          refuse(faults, here, "between", "'between' needs two bodies: forces of a body on itself cancel");
        break;
      case Of::section: expect(faults, here, "of", probe.of, "sections", names_of(scene.sections)); break;
      case Of::surface:
        expect(faults, here, "of", probe.of, "surfaces", names_of(mesh.surfaces));
        if (scene.gravity.isZero(0)) refuse(faults, here, "quantity", "'quantity' = " + probe.quantity + ": the scene has no gravity");
        break;
    }
  }
  for (const Stop& stop : scene.stops)
    if (stop.kind != StopKind::rest) expect(faults, {stop.at, "condition to stop"}, "probe", stop.probe, "probes", names_of(scene.probes));
}

/// Whether every body has its mesh, so that a name which names nothing is a fault of its own.
bool is_whole(const Scene& scene, const mesh::Mesh& mesh) {
  const Names sets = names_of(mesh.node_sets);
  return std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const Body& body) { return std::find(sets.begin(), sets.end(), body.name) != sets.end(); });
}

/// Whether each part of a body with a material of its own is a region or a set with elements.
void check_parts(const Scene& scene, const mesh::Mesh& mesh, Faults& faults) {
  for (const Body& body : scene.bodies) {
    Names known;
    for (const Set& set : body.sets)
      if (has_elements(body, set.name)) known.push_back(set.name);
    for (const std::string& region : names_of(mesh.hexahedra, mesh.triangles))
      if (region.rfind(body.name + ".", 0) == 0) known.push_back(region.substr(body.name.size() + 1));
    const std::vector<std::string> sets = names_of(mesh.node_sets);
    for (std::size_t p = 0; p < body.parts.size(); ++p) {
      const PartMaterial& part = body.parts[p];
      const Part here{part.at, "material of a part of body '" + body.name + "'"};
      if (!has(known, part.of) && has(sets, body.name + "." + part.of))
        refuse(faults, here, "of", "'of' = " + part.of + " is a node set and has no elements: name a region, or a set of zones in 'sets'");
      else expect(faults, here, "of", part.of, "regions and sets with elements of " + body.name, known);
      for (std::size_t q = 0; q < p; ++q)
        if (body.parts[q].of == part.of) refuse(faults, here, "of", "'of' = " + part.of + " is given twice");
    }
    const auto any_in = [&](const std::string& set, const auto& regions) {
      return std::any_of(regions.begin(), regions.end(), [&](const auto& region) {
        if (!belongs(region.name, body)) return false;
        const std::vector<char> inside = elements_in(body, set, mesh, region.nodes);
        return region.name == body.name + "." + set || std::find(inside.begin(), inside.end(), 1) != inside.end();
      });
    };
    for (const PartMaterial& part : body.parts)
      if (has(known, part.of) && !any_in(part.of, mesh.hexahedra) && !any_in(part.of, mesh.triangles))
        refuse(faults, {part.at, "material of a part of body '" + body.name + "'"}, "of",
               "'of' = " + part.of + " has no elements: no middle of one lies in it");
  }
}

/// Whatever names a part of the mesh names one that is there.
void check_names(const Scene& scene, const mesh::Mesh& mesh, Faults& faults) {
  const Names sets = names_of(mesh.node_sets), surfaces = names_of(mesh.surfaces), bodies = names_of(scene.bodies);
  for (const Contact& contact : scene.contacts) {
    expect(faults, part("contact", contact), "apexes", contact.apexes, "surfaces", surfaces);
    expect(faults, part("contact", contact), "base", contact.base, "surfaces", surfaces);
  }
  for (const AutomaticContact& contact : scene.automatic_contacts)
    for (std::size_t i = 0; i < contact.bodies.size(); ++i) {
      const std::string key = "bodies[" + std::to_string(i) + "]", &name = contact.bodies[i];
      const auto here = contact.bodies.begin() + static_cast<std::ptrdiff_t>(i);
      const Part of = part("contact", contact);
      expect(faults, of, key, name, "bodies", bodies);
      if (std::find(contact.bodies.begin(), here, name) != here) refuse(faults, of, key, quote(name) + " is given twice");
    }
  for (const Plane& plane : scene.planes)
    for (std::size_t i = 0; i < plane.nodes.size(); ++i)
      expect(faults, part("plane", plane), "nodes[" + std::to_string(i) + "]", plane.nodes[i], "node sets", sets);
  for (const RigidPlane& plane : scene.rigid_planes) expect(faults, part("plane", plane), "surface", plane.surface, "surfaces", surfaces);
  for (const Load& load : scene.loads) {
    const std::string key = load_syntax[static_cast<std::size_t>(load.kind)].key;
    if (key == "surface") expect(faults, part("load", load), key, load.on, "surfaces", surfaces);
    if (key == "body") expect(faults, part("load", load), key, load.on, "bodies", bodies);
    if (key == "nodes") expect(faults, part("load", load), key, load.on, "node sets", sets);
  }
  Names ends{"ground"};
  ends.insert(ends.end(), sets.begin(), sets.end());
  for (const Spring& spring : scene.springs) {
    expect(faults, part("spring", spring), "from", spring.from, "node sets", sets);
    expect(faults, part("spring", spring), "to", spring.to, "the ends of springs", ends);
  }
  for (const Section& section : scene.sections) expect(faults, part("section", section), "body", section.body, "bodies", bodies);
  for (const PointMass& mass : scene.point_masses) expect(faults, part("point mass", mass), "nodes", mass.nodes, "node sets", sets);
  for (const Initial& initial : scene.initial)
    expect(faults, {initial.at, "initial motion of '" + initial.body + "'"}, "body", initial.body, "bodies", bodies);
  for (const Stage& stage : scene.stages)
    for (const Initial& initial : stage.initial)
      expect(faults, {initial.at, "initial motion of '" + initial.body + "'"}, "body", initial.body, "bodies", bodies);
  check_parts(scene, mesh, faults);
  check_probes(scene, mesh, faults);
}

/// Options of the solids of a body; those of a fluid know gravity and the pressure of the start.
element::AnyHexahedronOptions options_of(const Body& body, const Vec3& gravity, const mesh::Mesh& mesh) {
  element::AnyHexahedronOptions options = body.solid;
  auto* fluid = std::get_if<element::Fluid::Options>(&options);
  if (fluid == nullptr) return options;
  const std::array<double, 3> g{gravity.x(), gravity.y(), gravity.z()};
  fluid->pressure = body.start.pressure;
  if (!body.start.hydrostatic) return options;
  fluid->gravity = g, fluid->level = std::numeric_limits<double>::infinity();
  for (const Index node : mesh::node_set(mesh, body.name)) fluid->level = std::min(fluid->level, gravity.dot(mesh.X.col(node)));
  return options;
}

/// Elements of one material, in a region of a mesh.
struct OneMaterial {
  std::string name;
  element::Connectivity nodes;
  const element::AnyLaw* law;
};

/// The elements of a region by their materials: those of parts have the name of their part, the others that of the region.
std::vector<OneMaterial> by_material(const Body& body, const std::string& region, const mesh::Mesh& mesh,
                                     const element::Connectivity& nodes) {
  std::vector<const PartMaterial*> part_of(static_cast<std::size_t>(nodes.cols()), nullptr);
  for (const PartMaterial& part : body.parts) {
    if (body.name + "." + part.of == region) std::fill(part_of.begin(), part_of.end(), &part);
    const std::vector<char> inside = elements_in(body, part.of, mesh, nodes);
    for (std::size_t e = 0; e < inside.size(); ++e)
      if (inside[e] != 0) part_of[e] = &part;
  }
  std::vector<const PartMaterial*> parts{nullptr};
  for (const PartMaterial& part : body.parts) parts.push_back(&part);
  std::vector<OneMaterial> all;
  for (const PartMaterial* part : parts) {
    std::vector<Eigen::Index> columns;
    for (std::size_t e = 0; e < part_of.size(); ++e)
      if (part_of[e] == part) columns.push_back(static_cast<Eigen::Index>(e));
    if (columns.empty()) continue;
    const bool whole = part == nullptr || body.name + "." + part->of == region;
    all.push_back({whole ? region : region + "." + part->of, nodes(Eigen::all, columns), part == nullptr ? &body.law : &part->law});
  }
  return all;
}

/// The elements of all bodies; a mesh from a file may have several regions, and parts of a body may have materials of their own.
void add_elements(const Scene& scene, dynamics::Model& model) {
  for (const Body& body : scene.bodies) {
    const element::AnyHexahedronOptions options = options_of(body, scene.gravity, model.mesh);
    for (const mesh::Hexahedra& region : model.mesh.hexahedra)
      if (belongs(region.name, body))
        for (const OneMaterial& one : by_material(body, region.name, model.mesh, region.nodes))
          model.blocks.push_back(element::solids(model.mesh, one.name, one.nodes, *one.law, options));
    for (const mesh::Triangles& region : model.mesh.triangles)
      if (belongs(region.name, body))
        for (const OneMaterial& one : by_material(body, region.name, model.mesh, region.nodes))
          model.blocks.push_back(element::plates(model.mesh, one.name, one.nodes, *one.law, body.plate));
  }
}

/// Whether every node has a mass, and it is a number.
bool have_masses(const Scene& scene, const dynamics::Model& model, Faults& faults) {
  Scalars mass = Scalars::Zero(model.mesh.X.cols());
  for (const auto& block : model.blocks) element::add_mass(block, mass);
  for (const load::PointMass& point : model.point_masses)
    for (const Index node : point.nodes) mass(node) += point.mass / static_cast<double>(point.nodes.size());
  const std::size_t before = faults.size();
  for (const Body& body : scene.bodies)
    for (const Index node : mesh::node_set(model.mesh, body.name)) {
      if (mass(node) > 0 && std::isfinite(mass(node))) continue;
      refuse(faults, part("body", body), "", mass(node) == 0 ? "a node has neither an element nor a point mass"
                                                             : "the mass of a node is " + shortest(mass(node)) + " kg");
    }
  return faults.size() == before;
}

std::array<Index, 3> sorted(const Table<3>& corners, Index facet) {
  std::array<Index, 3> nodes{corners(0, facet), corners(1, facet), corners(2, facet)};
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Half the thickness of the plates on a surface, if it is one of plates. [m]
double stand_off(const std::vector<Body>& bodies, const mesh::Mesh& mesh, const std::string& surface) {
  const Body& body = *std::find_if(bodies.begin(), bodies.end(), [&](const auto& one) { return belongs(surface, one); });
  if (!has_plates(body.mesh)) return 0;
  if (!has_solids(body.mesh)) return body.plate.thickness / 2;
  const auto facet = sorted(mesh::surface(mesh, surface).facets, 0);
  for (const mesh::Triangles& region : mesh.triangles)
    for (Index t = 0; t < region.nodes.cols(); ++t)
      if (sorted(region.nodes, t) == facet) return body.plate.thickness / 2;
  return 0;
}

void refuse_penetration(const auto& contact, bool given, const contact::InitialGaps& gaps, Faults& faults) {
  if (gaps.penetrating == 0 || contact.interface.initial_penetration == contact::InitialPenetration::accept) return;
  refuse(faults, part("contact", contact), "initial_penetration",
         formatted("%d of %d %s start penetrated, by %.4g m at most: %smove the bodies apart, or say 'initial_penetration: accept'",
                   static_cast<int>(gaps.penetrating), static_cast<int>(gaps.pairs > 0 ? gaps.pairs : gaps.apexes),
                   gaps.pairs > 0 ? "pairs of edges" : "apexes", gaps.deepest, given ? "lower 'height', " : ""));
}

void refuse_empty_tie(const Contact& contact, const contact::InitialGaps& gaps, Faults& faults) {
  if (contact.interface.kind != contact::InterfaceKind::tied || gaps.free < gaps.apexes) return;
  refuse(faults, part("contact", contact), "apexes",
         "0 of the " + std::to_string(gaps.apexes) + " apexes of '" + contact.apexes + "' are over '" + contact.base +
             "': expected at least one to be tied");
}

/// Whether the surfaces of a contact can be one.
bool can_touch(const Contact& contact, const dynamics::Model& model, Faults& faults) {
  const mesh::Surface &apexes = mesh::surface(model.mesh, contact.apexes), &base = mesh::surface(model.mesh, contact.base);
  const Subset of_apexes = mesh::surface_nodes(apexes), of_base = mesh::surface_nodes(base);
  const Part here = part("contact", contact);
  const std::size_t before = faults.size();
  if (std::find_first_of(of_apexes.begin(), of_apexes.end(), of_base.begin(), of_base.end()) != of_apexes.end())
    refuse(faults, here, "base", "'apexes' and 'base' share nodes: a surface does not touch itself");
  const auto look = [&](const char* key, const mesh::Surface& surface) {
    if (!mesh::goes_on(surface.facets))
      refuse(faults, here, key,
             quote(key) + " = " + surface.name + ": an edge belongs to two facets in the same direction: their normals do not agree");
  };
  look("base", base);
  if (contact.interface.two_passes) look("apexes", apexes);
  return faults.size() == before;
}

/// Takes what lies in a symmetry plane out of the skins of bodies: there the body goes on as its image.
void open_skins(dynamics::Model& model) {
  std::vector<char> in_plane(static_cast<std::size_t>(model.mesh.X.cols()));
  for (const load::Plane& plane : model.constraints.planes) {
    if (plane.kind != load::PlaneKind::symmetry) continue;
    std::fill(in_plane.begin(), in_plane.end(), 0);
    for (const Index node : plane.nodes) in_plane[static_cast<std::size_t>(node)] = 1;
    for (mesh::Surface& surface : model.mesh.surfaces) {
      if (surface.name.size() < 5 || surface.name.compare(surface.name.size() - 5, 5, ".skin") != 0) continue;
      Index kept = 0;
      for (Index f = 0; f < surface.facets.cols(); ++f) {
        const auto nodes = surface.facets.col(f);
        if (std::all_of(nodes.begin(), nodes.end(), [&](Index node) { return in_plane[static_cast<std::size_t>(node)] != 0; })) continue;
        surface.facets.col(kept++) = surface.facets.col(f).eval();
      }
      surface.facets.conservativeResize(3, kept);
    }
  }
}

std::string name_of_body(const std::string& surface) { return surface.substr(0, surface.find('.')); }

/// Whether any two bodies are left to an automatic contact, or one that touches itself and is not rigid.
bool any_touch(const Scene& scene, const std::vector<dynamics::TouchingBody>& bodies, const dynamics::PairsApart& apart) {
  const auto is_rigid = [&](const std::string& name) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) { return body.name == name && body.rigid; });
  };
  for (const dynamics::TouchingBody& one : bodies) {
    if (one.touches_itself && !is_rigid(one.name)) return true;
    for (const dynamics::TouchingBody& other : bodies)
      if (one.name != other.name && !dynamics::are_apart(apart, one.name, other.name)) return true;
  }
  return false;
}

/// Adds the automatic contacts: each pair of bodies that no contact or tie joins, nor an automatic contact before.
///
/// start  as of add_contacts
void add_automatic_contacts(const Scene& scene, const Vectors* start, dynamics::Model& model, std::vector<dynamics::Connected>& connected,
                            Faults& faults) {
  dynamics::PairsApart apart;
  for (const Contact& contact : scene.contacts) apart.emplace_back(name_of_body(contact.apexes), name_of_body(contact.base));
  std::set<std::string> touching_itself;
  for (const AutomaticContact& contact : scene.automatic_contacts) {
    const Names names = contact.bodies.empty() ? names_of(scene.bodies) : contact.bodies;
    const Part here = part("contact", contact);
    std::vector<dynamics::TouchingBody> bodies;
    const std::size_t before = faults.size();
    for (const std::string& name : names) {
      if (!mesh::goes_on(mesh::surface(model.mesh, name + ".skin").facets))
        refuse(faults, here, "bodies", "the skin of " + quote(name) + " has an edge of several facets whose normals do not agree");
      bodies.push_back({name, contact.self_contact && touching_itself.insert(name).second});
    }
    if (faults.size() > before) continue;
    if (!any_touch(scene, bodies, apart)) {
      refuse(faults, here, contact.self_contact ? "bodies" : "self_contact",
             "no pair is left for this contact: other contacts have all pairs of these bodies, and no body has self-contact");
      continue;
    }
    for (dynamics::Connected& one : dynamics::connect_automatic(model, contact.name, bodies, apart, contact.interface, start)) {
      refuse_penetration(contact, false, one.gaps, faults);
      connected.push_back(std::move(one));
    }
    for (const std::string& one : names)
      for (const std::string& other : names) apart.emplace_back(one, other);
  }
}

/// Adds the contacts to a model that is finished.
///
/// start  [m] positions at the start where they are not the reference, else null
std::vector<dynamics::Connected> add_contacts(const Scene& scene, const Vectors* start, dynamics::Model& model, Faults& faults) {
  std::vector<dynamics::Connected> connected;
  for (const Contact& contact : scene.contacts) {
    if (!can_touch(contact, model, faults)) continue;
    dynamics::InterfaceOptions options = contact.interface;
    if (contact.height_from_thickness)
      options.height = {.from_initial_height = false,
                        .clearance = 0,
                        .given = stand_off(scene.bodies, model.mesh, contact.apexes) + stand_off(scene.bodies, model.mesh, contact.base),
                        .from_thickness = true};
    for (dynamics::Connected& pass : dynamics::connect(model, contact.name, contact.apexes, contact.base, options, start)) {
      const auto& height = contact.interface.height;
      refuse_penetration(contact, !contact.height_from_thickness && !height.from_initial_height && height.given > 0, pass.gaps, faults);
      refuse_empty_tie(contact, pass.gaps, faults);
      connected.push_back(std::move(pass));
    }
  }
  add_automatic_contacts(scene, start, model, connected, faults);
  return connected;
}

void add_sections(const Scene& scene, dynamics::Model& model, Faults& faults) {
  for (const Section& section : scene.sections) {
    std::vector<std::size_t> blocks;
    bool rigid = false;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
      const std::string& region = element::name(model.blocks[b]);
      if (region != section.body && region.rfind(section.body + ".", 0) != 0) continue;
      blocks.push_back(b), rigid = rigid || dynamics::is_rigid_block(model, b);
    }
    const Part here = part("section", section);
    if (rigid) {
      refuse(faults, here, "body", "'body' = " + section.body + " is a rigid body: no stress carries a force across it");
      continue;
    }
    model.sections.push_back(dynamics::make_section(model, section.name, blocks, {section.point, section.normal, section.radius}));
    if (!model.sections.back().parts.empty()) continue;
    const bool round = section.radius > 0;
    refuse(faults, here, round ? "radius" : "point",
           std::string(round ? "the cylinder" : "the plane") + " does not cut " + section.body + ": all its nodes are on one side");
  }
}

/// Throws MachineError where the elements alone would take more memory than there is: the system would end this program, or another one.
void check_memory(const Scene& scene) {
  constexpr double least = 1300;  // [bytes] an element takes in a run; measured 1300 to 1800
  double elements = 0;
  for (const Body& body : scene.bodies)
    if (const double count = count_elements(body.mesh); count <= most_elements) elements += count;  // others are a fault
  const double needed = least * elements, left = memory_left();
  if (needed <= left) return;
  throw MachineError(formatted("memory does not suffice: %.3g elements take at least %.3g GB, and %.3g GB are left", elements,
                               needed / 1e9, left / 1e9));
}

/// Says which materials of bodies with parts no element has: later parts, or all of them together, cover the earlier ones.
void add_remarks(const Scene& scene, const dynamics::Model& model, std::vector<std::string>& remarks) {
  for (const Body& body : scene.bodies) {
    if (body.parts.empty()) continue;
    const auto is_used = [&](const std::string& part) {
      return std::any_of(model.blocks.begin(), model.blocks.end(), [&](const element::AnyBlock& block) {
        const std::string& name = element::name(block);
        if (!belongs(name, body)) return false;
        const std::string last = name.substr(name.rfind('.') + 1);
        const bool is_of_part = std::any_of(body.parts.begin(), body.parts.end(), [&](const PartMaterial& one) { return one.of == last; });
        return part.empty() ? !is_of_part : last == part;
      });
    };
    if (!is_used("")) remarks.push_back(body.name + ": no element has its 'material': its 'materials' have all elements");
    for (const PartMaterial& part : body.parts)
      if (!is_used(part.of))
        remarks.push_back(body.name + ": no element has the material of '" + part.of + "': later parts have its elements");
  }
}

}  // namespace

Simulation build(const Scene& scene) {
  Faults faults;
  if (scene.bodies.empty()) refuse(faults, {"", "the scene"}, "bodies", "there are no bodies");
  check_names_given(scene, faults);
  check_values(scene, faults);
  check_stages(scene, faults);
  throw_if_any(faults);
  check_memory(scene);

  Simulation simulation;
  dynamics::Model& model = simulation.model;
  model.mesh = make_mesh(scene, faults, simulation.mesh_warnings);
  if (is_whole(scene, model.mesh)) check_names(scene, model.mesh, faults);
  throw_if_any(faults);

  add_elements(scene, model);
  add_planes(scene, model, faults);
  const load::Constraints all_planes = model.constraints;
  if (!scene.stages.empty()) model.constraints = constraints_in(scene.stages.front(), all_planes);
  open_skins(model);
  if (!have_masses(scene, model, faults)) throw_if_any(faults);
  const std::size_t before = faults.size();
  if (scene.time.largest_step > 0) model.longest_step = scene.time.largest_step;
  add_rigid_bodies(scene, model, faults);
  simulation.stages = make_stages(scene, all_planes, model, faults);
  if (faults.size() > before) throw_if_any(faults);
  dynamics::finalize(model);
  add_rigid_planes(scene, model);
  add_loads(scene, model, faults);
  const std::optional<InitialField> displacement = initial_displacement(scene, model, faults);
  const Vectors start = displacement ? Vectors(model.mesh.X + displacement->value) : model.mesh.X;
  check_sides_of_planes(scene, model, start, faults);
  std::vector<dynamics::Connected> connected = add_contacts(scene, displacement ? &start : nullptr, model, faults);
  add_sections(scene, model, faults);
  check_columns(scene, model, faults);
  throw_if_any(faults);

  std::vector<contact::AnyMemory> memories;
  for (dynamics::Connected& one : connected) {
    simulation.gaps.push_back(one.gaps);
    memories.push_back(std::move(one.memory));
  }
  simulation.state = dynamics::initial_state(model, std::move(memories));
  set_initial(scene, model, displacement, simulation.state, faults);
  set_velocities_of_stages(scene, simulation, faults);
  check_rigid_bodies(scene, model, simulation.state, faults);
  for (contact::AnyContact& any : model.contacts)
    if (contact::tied_by_multipliers(any)) contact::tie_here(simulation.state.x, std::get<contact::Interface>(any));
  simulation.forces = dynamics::make_forces(model);
  simulation.probes = make_probes(scene, model, simulation.state, faults, simulation.remarks);
  add_remarks(scene, model, simulation.remarks);
  throw_if_any(faults);

  simulation.time = scene.time;
  simulation.recording = scene.recording;
  if (!(simulation.recording.history > 0)) simulation.recording.history = usual_rows(scene.recording.frames, scene.time.end);
  if (!(simulation.time.audit_every > 0))  // however many frames there are by default
    simulation.time.audit_every = scene.recording.frames > 0 ? scene.recording.frames : scene.time.end / 40;
  simulation.stops = scene.stops;
  return simulation;
}

dynamics::Outcome run(Simulation& simulation, std::span<const dynamics::Observer> observers, const dynamics::Interrupt& interrupt) {
  dynamics::Watch watch{.probes = simulation.probes, .observers = observers, .until = {}, .interrupt = interrupt};
  dynamics::Until until;
  if (!simulation.stops.empty())
    until = [&simulation](const dynamics::View& view, auto& memories) { return wanted_stop(simulation, view, memories); };
  const std::vector<double>& began = simulation.state.progress.stages;
  for (double seconds = 0;;) {
    const bool last = began.size() >= simulation.stages.size();
    dynamics::Time time = simulation.time;
    if (!began.empty()) time.end = began.back() + simulation.stages[began.size() - 1].duration;
    watch.until = last ? until : dynamics::Until();
    dynamics::Outcome outcome =
        dynamics::run(simulation.model, simulation.state, simulation.forces, time, simulation.recording.history, watch);
    outcome.wall_seconds = seconds += outcome.wall_seconds;
    if (last || !dynamics::good(outcome.ending)) return outcome;
    begin_next_stage(simulation);
  }
}

dynamics::View view(const Simulation& simulation) {
  return {simulation.model, simulation.state, simulation.forces, simulation.state.progress.ledger_is_current};
}

const dynamics::ProbeMemory& probe(const Simulation& simulation, const std::string& name) {
  for (std::size_t p = 0; p < simulation.probes.size(); ++p)
    if (simulation.probes[p].name == name && p < simulation.state.probes.size()) return simulation.state.probes[p];
  throw InternalError("no probe '" + name + "' has measured anything");
}

}  // namespace nereid::model
