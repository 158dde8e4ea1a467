#include "model/probes.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/words.hpp"
#include "dynamics/measure.hpp"
#include "model/sets.hpp"

namespace nereid::model {

namespace {

using dynamics::Kept;
using dynamics::View;
using Measure = std::function<double(const View&, Kept&)>;

const std::vector<std::string> axes{"x", "y", "z"};
const std::vector<std::string> of_vectors{"magnitude", "x", "y", "z"};
const std::vector<std::string> of_forces{"magnitude", "x", "y", "z", "normal"};
const std::vector<std::string> of_tensors{"xx", "yy", "zz", "xy", "yz", "xz"};

/// Internal variables of all laws, each once.
template <class... Laws>
std::vector<material::Variable> internal_variables(const std::variant<Laws...>*) {
  std::vector<material::Variable> all;
  const auto add = [&all](const auto& internal) {
    for (const material::Variable& one : internal)
      if (std::none_of(all.begin(), all.end(), [&](const auto& other) { return other.name == one.name; })) all.push_back(one);
  };
  (add(Laws::internal), ...);
  return all;
}

/// One component of a vector by its name; value(view, kept) is the vector.
template <class Value>
Measure component(const std::string& name, const Vec3& normal, Value&& value) {
  if (name == "magnitude") return [value](const View& view, Kept& kept) { return value(view, kept).norm(); };
  if (name == "normal") return [value, normal](const View& view, Kept& kept) { return value(view, kept).dot(normal); };
  const int axis = name[0] - 'x';
  return [value, axis](const View& view, Kept& kept) -> double { return value(view, kept)(axis); };
}

/// Places in Model::contacts of a contact of the scene: one, or two passes with the sides exchanged; and of its edges.
std::vector<std::size_t> passes(const dynamics::Model& model, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    for (const char* part : {"", "_back", "_edges"})
      if (contact::sides(model.contacts[c]).name == name + part) found.push_back(c);
  return found;
}

// Gap and area of the surface with the apexes; the pressure is the largest of both surfaces where there are two passes.
double gap(const View& view, const std::vector<std::size_t>& passes) { return dynamics::least_gap(view, passes[0]); }
double contact_area(const View& view, const std::vector<std::size_t>& passes) { return dynamics::contact_state(view, passes[0]).area; }
/// On the surface with the apexes: of a second pass it is what pushes back.
Vec3 current_force(const View& view, const std::vector<std::size_t>& passes) {
  Vec3 sum = Vec3::Zero();
  for (const std::size_t pass : passes) sum += contact::side_of(view.model.contacts[pass]) * contact::sides(view.now.contacts[pass]).force;
  return sum;
}
double contact_pressure(const View& view, const std::vector<std::size_t>& passes) {
  double largest = 0;
  for (const std::size_t pass : passes) largest = std::max(largest, dynamics::contact_state(view, pass).largest_pressure);
  return largest;
}

/// What is measured of nodes or of a contact, with the component that a probe asks for.
struct Measuring {
  const std::string& along;
  const Subset& nodes;
  const std::vector<std::size_t>& passes;

  Measure operator()(std::monostate) const { return {}; }
  Measure operator()(Vec3 (*value)(const View&, const Subset&)) const {
    return component(along, Vec3::Zero(), [value, nodes = nodes](const View& view, Kept&) { return value(view, nodes); });
  }
  Measure operator()(double (*value)(const View&, const Subset&)) const {
    return [value, nodes = nodes](const View& view, Kept&) { return value(view, nodes); };
  }
  Measure operator()(double (*value)(const View&, const Subset&, int)) const {
    return [value, nodes = nodes, axis = along[0] - 'x'](const View& view, Kept&) { return value(view, nodes, axis); };
  }
  Measure operator()(Vec3 (*value)(const View&, const Subset&, Kept&)) const {
    return component(along, Vec3::Zero(), [value, nodes = nodes](const View& view, Kept& kept) { return value(view, nodes, kept); });
  }
  Measure operator()(Vec3 (*value)(const View&, const std::vector<std::size_t>&)) const {
    return component(along, Vec3::Zero(), [value, passes = passes](const View& view, Kept&) { return value(view, passes); });
  }
  Measure operator()(double (*value)(const View&, const std::vector<std::size_t>&)) const {
    return [value, passes = passes](const View& view, Kept&) { return value(view, passes); };
  }
};

/// The regions of a body from a file, or the body itself: places in Model::blocks. Of a set with elements the blocks of its body.
std::vector<std::size_t> blocks_of(const dynamics::Model& model, const std::string& body) {
  std::vector<std::size_t> blocks;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const std::string& region = element::name(model.blocks[b]);
    if (region == body || region.rfind(body + ".", 0) == 0) blocks.push_back(b);
  }
  return blocks;
}

/// Refuses a place of solids, none or another one of plates, and bodies that have both.
void check_place(const Probe& probe, const dynamics::Model& model, const std::vector<std::size_t>& blocks, Faults& faults) {
  const Part here = part("probe", probe);
  const auto is_plate = [&](std::size_t b) { return element::rotates(model.blocks[b]); };
  const bool plates = std::any_of(blocks.begin(), blocks.end(), is_plate), solids = !std::all_of(blocks.begin(), blocks.end(), is_plate);
  const std::vector<std::string> places(element::words_of_places.begin(), element::words_of_places.end());
  if (plates && solids) {
    std::vector<std::string> regions;
    for (const std::size_t b : blocks) regions.push_back(element::name(model.blocks[b]));
    refuse(faults, here, "of",
           "'of' = " + probe.of + " has solids and plates, whose " + probe.quantity + " differ: take one of its regions, " +
               joined(regions));
  } else if (plates && probe.place.empty()) {
    refuse(faults, here, "place",
           "'place' is missing: the " + probe.quantity + " of plates differs through their thickness: one of " + joined(places),
           "'membrane' is the mean through the thickness; scripts/update_case gives old case files their places");
  } else if (plates) {
    expect(faults, here, "place", probe.place, "places of plates", places);
  } else if (!probe.place.empty()) {
    refuse(faults, here, "place", "'place' = " + probe.place + ": " + probe.of + " has no plates: leave 'place' out");
  }
}

/// Which elements of some blocks a probe measures: all, those of a set, or the nearest to a place.
struct MeasuredElements {
  std::vector<std::size_t> blocks;
  std::optional<dynamics::PickedElements> picked;  ///< none: all of the blocks
};

using ElementsOfBlock = std::vector<Index>;

dynamics::PickedElements pick(const dynamics::Model& model, const std::vector<std::size_t>& blocks,
                              const std::vector<ElementsOfBlock>& elements) {
  dynamics::PickedElements picked;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (elements[i].empty()) continue;
    picked.blocks.push_back(blocks[i]), picked.picked.push_back(element::pick(model.blocks[blocks[i]], elements[i]));
  }
  return picked;
}

/// The elements of a set of a body, block by block; nothing if the name is none of such a set.
std::optional<std::vector<ElementsOfBlock>> elements_of_set(const std::string& name, const Scene& scene, const dynamics::Model& model,
                                                            const std::vector<std::size_t>& blocks) {
  for (const Body& body : scene.bodies) {
    if (!belongs(name, body) || name.size() <= body.name.size()) continue;
    const std::string set = name.substr(body.name.size() + 1);
    if (!has_elements(body, set)) return std::nullopt;
    std::vector<ElementsOfBlock> all;
    for (const std::size_t b : blocks) {
      const std::vector<char> inside = elements_in(body, set, model.mesh, element::nodes(model.blocks[b]));
      all.emplace_back();
      for (std::size_t e = 0; e < inside.size(); ++e)
        if (inside[e] != 0) all.back().push_back(static_cast<Index>(e));
    }
    return all;
  }
  return std::nullopt;
}

/// Of some elements those whose middles are nearest to a place; several that are equally near to 1e-6 of the distance or of the body.
std::vector<ElementsOfBlock> nearest_of(const Vec3& near, const dynamics::Model& model, const std::vector<std::size_t>& blocks,
                                        std::vector<ElementsOfBlock> elements, double size) {
  constexpr double same = 1e-6;
  double least = std::numeric_limits<double>::infinity();
  std::vector<Vectors> middle;
  for (const std::size_t b : blocks) middle.push_back(middles(model.mesh.X, element::nodes(model.blocks[b])));
  const auto away = [&](std::size_t i, Index e) { return (middle[i].col(e) - near).norm(); };
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (const Index e : elements[i]) least = std::min(least, away(i, e));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    ElementsOfBlock& here = elements[i];
    here.erase(std::remove_if(here.begin(), here.end(), [&](Index e) { return away(i, e) > least + same * size; }), here.end());
  }
  return elements;
}

/// How large some elements are together, and how far a place lies beside them. [m]
struct Extent {
  double size = 0, beside = 0;
};
Extent extent_of(const dynamics::Model& model, const std::vector<std::size_t>& blocks, const std::vector<ElementsOfBlock>& elements,
                 const Vec3& near) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (const Index e : elements[i])
      for (const Index node : element::nodes(model.blocks[blocks[i]]).col(e))
        low = low.cwiseMin(model.mesh.X.col(node)), high = high.cwiseMax(model.mesh.X.col(node));
  return {(high - low).norm(), (near - near.cwiseMax(low).cwiseMin(high)).norm()};
}

/// The elements that a probe measures.
MeasuredElements elements_of(const Probe& probe, const Scene& scene, const dynamics::Model& model, Faults& faults) {
  MeasuredElements measured{blocks_of(model, probe.of), {}};
  std::optional<std::vector<ElementsOfBlock>> chosen;
  if (measured.blocks.empty()) {  // a set
    measured.blocks = blocks_of(model, probe.of.substr(0, probe.of.find('.')));
    chosen = elements_of_set(probe.of, scene, model, measured.blocks);
    if (chosen && std::all_of(chosen->begin(), chosen->end(), [](const auto& one) { return one.empty(); })) {
      refuse(faults, part("probe", probe), "of", "'of' = " + probe.of + " has no elements: no middle of one lies in it");
      return measured;
    }
  }
  if (probe.near) {
    if (!chosen) {
      chosen.emplace();
      for (const std::size_t b : measured.blocks) {
        chosen->emplace_back(static_cast<std::size_t>(element::tiling(model.blocks[b]).elements));
        for (std::size_t e = 0; e < chosen->back().size(); ++e) chosen->back()[e] = static_cast<Index>(e);
      }
    }
    const auto [size, beside] = extent_of(model, measured.blocks, *chosen, *probe.near);
    if (beside > 1e-3 * size)
      refuse(faults, part("probe", probe), "near", formatted("'near' lies %.4g m beside '%s'", beside, probe.of.c_str()));
    chosen = nearest_of(*probe.near, model, measured.blocks, std::move(*chosen), size);
  }
  if (!chosen) return measured;
  const dynamics::PickedElements picked = pick(model, measured.blocks, *chosen);
  measured.blocks = picked.blocks;  // places and variables are judged by what is measured alone
  measured.picked = picked;
  return measured;
}

/// Weights of the components of a tensor whose sum is its value along a unit vector n:  n . S n.
std::array<double, 6> weights_along(const Vec3& n) {
  return {n.x() * n.x(), n.y() * n.y(), n.z() * n.z(), 2 * n.x() * n.y(), 2 * n.y() * n.z(), 2 * n.x() * n.z()};
}

Measure of_body(const Probe& probe, int row, const Scene& scene, const dynamics::Model& model, const dynamics::State& at_start,
                Faults& faults) {
  const MeasuredElements elements = elements_of(probe, scene, model, faults);
  const std::vector<std::size_t>& blocks = elements.blocks;
  check_place(probe, model, blocks, faults);
  bool measured = true;
  for (const std::size_t b : blocks) {
    if (dynamics::is_rigid_block(model, b))
      refuse(faults, part("probe", probe), "of", "'of' = " + probe.of + " is a rigid body and has no " + probe.quantity);
    const element::Wanted wanted = [&](const element::Shown& one) { return one.quantity == probe.quantity; };
    measured = measured && !element::fields(model.blocks[b], model.mesh.X, at_start.x, at_start.blocks[b], wanted).empty();
  }
  if (!measured)
    refuse(faults, part("probe", probe), "quantity",
           "'quantity' = " + probe.quantity + ": the material of " + probe.of + " has no such variable");
  if (!faults.empty()) return {};
  const auto take = probe.largest ? dynamics::Take::largest : dynamics::Take::mean;
  const auto value = [elements, quantity = probe.quantity, place = element::place_of(probe.place), take](const View& view, int component) {
    const element::Shown shown{quantity, place};
    return elements.picked ? dynamics::of_elements(view, *elements.picked, shown, component, take)
                           : dynamics::of_body(view, elements.blocks, shown, component, take);
  };
  if (!probe.along) return [value, row](const View& view, Kept&) { return value(view, row); };
  return [value, weight = weights_along(*probe.along)](const View& view, Kept&) {
    double sum = 0;
    for (int c = 0; c < 6; ++c)
      if (weight[static_cast<std::size_t>(c)] != 0) sum += weight[static_cast<std::size_t>(c)] * value(view, c);
    return sum;
  };
}

/// Of two bodies in an automatic contact.
Measure of_pair(const Probe& probe, const std::string& along, const dynamics::Model& model, Faults& faults) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto touches = [&](const contact::AnyContact& any) {
      const auto& names = contact::sides(any).bodies.names;
      return std::find(names.begin(), names.end(), probe.between[i]) != names.end();
    };
    const auto contacts = passes(model, probe.of);
    if (std::none_of(contacts.begin(), contacts.end(), [&](std::size_t c) { return touches(model.contacts[c]); }))
      refuse(faults, part("probe", probe), "between[" + std::to_string(i) + "]",
             quote(probe.between[i]) + " is not in the contact " + quote(probe.of));
  }
  if (along == "normal") refuse(faults, part("probe", probe), "component", "'component' = normal: a pair of bodies has no normal");
  if (probe.quantity == "impulse")
    return component(along, Vec3::Zero(), [name = probe.of, of = probe.between](const View& view, Kept&) {
      return dynamics::pair_impulse(view, name, of[0], of[1]);
    });
  return component(along, Vec3::Zero(), [name = probe.of, of = probe.between](const View& view, Kept& kept) {
    return dynamics::mean_pair_force(view, name, of[0], of[1], kept);
  });
}

Measure of_source(const Probe& probe, const std::string& along, const dynamics::Model& model, Faults& faults) {
  if (!probe.between[0].empty()) return of_pair(probe, along, model, faults);
  const auto here = [&](const auto& one) { return one.name == probe.of; };
  const auto contacts = passes(model, probe.of);
  const auto rigid = std::find_if(model.rigid_planes.begin(), model.rigid_planes.end(), here);
  const auto plane = std::find_if(model.constraints.planes.begin(), model.constraints.planes.end(), here);
  Vec3 normal = Vec3::Zero();
  if (rigid != model.rigid_planes.end()) normal = rigid->normal;
  const auto has_normal = [](load::PlaneKind kind) { return kind != load::PlaneKind::fixed && kind != load::PlaneKind::driven; };
  if (plane != model.constraints.planes.end() && has_normal(plane->kind)) normal = plane->normal;
  if (along == "normal" && normal.isZero(0))
    refuse(faults, part("probe", probe), "component", "'component' = normal: " + probe.of + " is no plane and has no normal");
  const bool total = probe.quantity == "impulse";
  for (std::size_t s = 0; s < model.sections.size(); ++s) {
    if (model.sections[s].name != probe.of) continue;
    if (total) return component(along, normal, [s](const View& view, Kept&) { return view.now.sections[s].impulse; });
    return component(along, normal, [s](const View& view, Kept& kept) { return dynamics::mean_section_force(view, s, kept); });
  }
  if (!contacts.empty() && total)
    return component(along, normal, [contacts](const View& view, Kept&) {
      Vec3 sum = Vec3::Zero();
      for (const std::size_t pass : contacts)
        sum += contact::side_of(view.model.contacts[pass]) * contact::sides(view.now.contacts[pass]).impulse;
      return sum;
    });
  if (!contacts.empty())
    return component(along, normal, [contacts](const View& view, Kept& kept) {
      return dynamics::mean_contact_force(view, contacts, kept);
    });
  const auto spring = std::find_if(model.loads.begin(), model.loads.end(), [&](const auto& load) { return load::name(load) == probe.of; });
  if (total && spring != model.loads.end() && load::is_spring(*spring))
    refuse(faults, part("probe", probe), "quantity",
           "'quantity' = impulse: " + probe.of + " is a spring, whose ends have opposite impulses; its force is that on 'from'");
  if (total) {
    const std::size_t source = dynamics::source_of(model, probe.of);
    return component(along, normal, [source](const View& view, Kept&) { return view.now.ledger.accounts[source].impulse; });
  }
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    if (load::name(model.loads[l]) == probe.of && load::is_spring(model.loads[l]))
      return component(along, normal, [l](const View& view, Kept&) -> Vec3 { return view.now.loads[l].force.col(0); });
  const std::size_t source = dynamics::source_of(model, probe.of);
  return component(along, normal, [source](const View& view, Kept& kept) { return dynamics::mean_force(view, source, kept); });
}

/// Of a surface of a fluid.
Measure of_surface(const Probe& probe, const dynamics::Model& model, const dynamics::State& at_start, Faults& faults) {
  const std::vector<std::size_t> blocks = blocks_of(model, probe.of.substr(0, probe.of.find('.')));
  double density = 0;
  for (const std::size_t b : blocks)
    std::visit([&](const auto& block) { density = material::FluidLaw<std::decay_t<decltype(block.law)>> ? block.law.density : density; },
               model.blocks[b]);
  if (!(density > 0)) {
    refuse(faults, part("probe", probe), "of", "'of' = " + probe.of + " is no surface of a fluid and has no " + probe.quantity);
    return {};
  }
  const auto surface = dynamics::free_surface(model, mesh::surface(model.mesh, probe.of), density, at_start.x);
  return [surface](const View& view, Kept&) { return dynamics::wave_energy(view, surface); };
}

/// Place of the probe's component; faults for one that there is not.
int component_of(const Probe& probe, const Measurable& quantity, Faults& faults) {
  const auto& names = quantity.components;
  if (probe.along && !is_tensor(quantity))
    refuse(faults, part("probe", probe), "along", "'along': " + quantity.name + " is no tensor and has no value along a direction");
  if (probe.along && probe.largest)
    refuse(faults, part("probe", probe), "take",
           "'take' = largest: along a direction a probe has the mean, or the value of the element at 'near'");
  if (probe.along && !probe.component.empty())
    refuse(faults, part("probe", probe), "component", "'component' and 'along' are two directions: give one of them");
  if (probe.along) return 0;
  if (probe.component.empty() && quantity.required)
    refuse(faults, part("probe", probe), "component", "'component' is missing: one of " + joined(names));
  if (probe.component.empty()) return 0;
  expect(faults, part("probe", probe), "component", probe.component, "components of " + quantity.name, names);
  const auto at = std::find(names.begin(), names.end(), probe.component);
  return at == names.end() ? 0 : static_cast<int>(at - names.begin());
}

Measure measure(const Probe& probe, const Measurable& quantity, const Scene& scene, const dynamics::Model& model,
                const dynamics::State& at_start, Faults& faults) {
  const int row = component_of(probe, quantity, faults);
  const std::string along = quantity.components.empty() ? "x" : quantity.components[static_cast<std::size_t>(row)];
  if (quantity.of == Of::body) return of_body(probe, row, scene, model, at_start, faults);
  if (quantity.of == Of::source) return of_source(probe, along, model, faults);
  if (quantity.of == Of::surface) return of_surface(probe, model, at_start, faults);
  if (quantity.of == Of::section)
    for (std::size_t s = 0; s < model.sections.size(); ++s)
      if (model.sections[s].name == probe.of)
        return component(along, Vec3::Zero(), [s](const View& view, Kept&) { return view.now.sections[s].moment; });
  const Subset nodes = quantity.of == Of::nodes ? mesh::node_set(model.mesh, probe.of) : Subset{};
  return std::visit(Measuring{along, nodes, passes(model, probe.of)}, quantity.measurement);
}

/// Whether a probe is of means over time: of forces, but for those of springs, which are known at any moment.
bool is_mean(const Probe& probe, const dynamics::Model& model) {
  const auto is_it = [&](const load::AnyLoad& load) { return load::name(load) == probe.of && load::is_spring(load); };
  return probe.quantity == "acceleration" || (probe.quantity == "force" && std::none_of(model.loads.begin(), model.loads.end(), is_it));
}

dynamics::FollowsMesh follows_mesh(const Probe& probe, const dynamics::Model& model) {
  if (probe.quantity != "plastic_strain" || !probe.largest) return dynamics::FollowsMesh::no;
  const auto has_one_point = [&](std::size_t b) {
    return std::visit([]<class Kind, class Law>(const element::Block<Kind, Law>&) { return std::is_same_v<Kind, element::Hexahedron>; },
                      model.blocks[b]);
  };
  const std::vector<std::size_t> blocks = blocks_of(model, probe.of);
  return std::any_of(blocks.begin(), blocks.end(), has_one_point) ? dynamics::FollowsMesh::less_with_eight_points
                                                                  : dynamics::FollowsMesh::yes;
}

/// The contact or rigid plane whose force a probe measures, as a place in State::footings; -1: it measures something else.
int footing_of(const Probe& probe, const dynamics::Model& model) {
  const bool is_force = probe.quantity == "force" || probe.quantity == "current_force" || probe.quantity == "contact_pressure";
  if (!is_force) return -1;
  if (const auto contacts = passes(model, probe.of); !contacts.empty()) return static_cast<int>(contacts[0]);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p)
    if (model.rigid_planes[p].name == probe.of) return static_cast<int>(model.contacts.size() + p);
  return -1;
}

}  // namespace

const std::vector<Measurable>& measurables() {
  static const std::vector<Measurable> all = [] {
    std::vector<Measurable> list{
        {"displacement", "m", Of::nodes, of_vectors, false, dynamics::mean_displacement},
        {"velocity", "m/s", Of::nodes, of_vectors, false, dynamics::mean_velocity},
        {"acceleration", "m/s^2", Of::nodes, of_vectors, false, dynamics::mean_acceleration},
        {"position", "m", Of::nodes, axes, true, dynamics::mean_position},
        {"extent", "m", Of::nodes, axes, true, dynamics::extent},
        {"radius", "m", Of::nodes, axes, true, dynamics::radius},
        {"momentum", "kg m/s", Of::nodes, of_vectors, false, dynamics::momentum},
        {"kinetic_energy", "J", Of::nodes, {}, false, dynamics::kinetic_energy},
        {"angular_velocity", "rad/s", Of::nodes, of_vectors, false, dynamics::mean_spin},
        {"angular_momentum", "N*m*s", Of::nodes, of_vectors, false, dynamics::angular_momentum},
        {"force", "N", Of::source, of_forces},
        {"impulse", "N*s", Of::source, of_forces},
        {"section_moment", "N*m", Of::section, of_vectors},
        {"current_force", "N", Of::contact, of_vectors, false, current_force},
        {"gap", "m", Of::contact, {}, false, gap},
        {"contact_pressure", "Pa", Of::any_contact, {}, false, contact_pressure},
        {"contact_area", "m^2", Of::contact, {}, false, contact_area},
        {"wave_energy", "J", Of::surface},
        {"stress", "Pa", Of::body, of_tensors, true},
        {"strain", "1", Of::body, of_tensors, true},
        {"pressure", "Pa", Of::body},
        {"von_mises", "Pa", Of::body},
    };
    for (const auto& [name, unit] : internal_variables(static_cast<const element::AnyLaw*>(nullptr)))
      list.push_back({std::string(name), std::string(unit), Of::body});
    return list;
  }();
  return all;
}

const Measurable* find_measurable(const std::string& quantity) {
  for (const Measurable& one : measurables())
    if (one.name == quantity) return &one;
  return nullptr;
}

bool is_tensor(const Measurable& quantity) { return quantity.components == of_tensors; }

namespace {

/// Which element a probe at a place measures.
std::string gauge_line(const Probe& probe, const Scene& scene, const dynamics::Model& model, Faults& faults) {
  const MeasuredElements measured = elements_of(probe, scene, model, faults);
  if (!measured.picked) return "";
  const dynamics::PickedElements& picked = *measured.picked;
  std::size_t count = 0;
  for (const element::Picked& one : picked.picked) count += one.place.size();
  const element::AnyBlock& block = model.blocks[picked.blocks[0]];
  const Index element = element::tiling(block).element[picked.picked[0].place[0]];
  const double away = (middles(model.mesh.X, element::nodes(block)).col(element) - *probe.near).norm();
  const std::string which = count == 1 ? "element " + std::to_string(element) + " of '" + element::name(block) + "', whose middle lies"
                                       : "the mean of " + std::to_string(count) + " elements of '" + probe.of + "', whose middles lie";
  return formatted("gauge '%s': %s %.3g m from its place", probe.name.c_str(), which.c_str(), away);
}

/// A probe that is computed from those before it.
dynamics::Probe make_formula(const Probe& probe, const Scene& scene, const std::vector<dynamics::Probe>& before, Faults& faults) {
  dynamics::Probe made{.name = probe.name, .unit = probe.formula.unit, .value = {}};
  std::vector<std::string> names;
  for (std::size_t p = 0; p < before.size(); ++p) names.push_back(scene.probes[p].name);
  for (const std::string& input : probe.formula.inputs) {
    const auto at = std::find(names.begin(), names.end(), input);
    expect(faults, part("probe", probe), "value", input, "probes above it", names);
    if (at == names.end()) continue;
    made.inputs.push_back(static_cast<std::size_t>(at - names.begin()));
    made.is_mean = made.is_mean || before[made.inputs.back()].is_mean;
  }
  made.formula = probe.formula.value;
  return made;
}

}  // namespace

std::vector<dynamics::Probe> make_probes(const Scene& scene, const dynamics::Model& model, const dynamics::State& at_start,
                                         Faults& faults, std::vector<std::string>& remarks) {
  std::vector<dynamics::Probe> made;
  for (const Probe& probe : scene.probes) {
    if (probe.formula.value) {
      made.push_back(make_formula(probe, scene, made, faults));
      continue;
    }
    const Measurable* quantity = find_measurable(probe.quantity);
    if (probe.near && faults.empty()) remarks.push_back(gauge_line(probe, scene, model, faults));
    Probe of_all = probe;
    of_all.largest = false;
    const dynamics::FollowsMesh follows = follows_mesh(probe, model);
    made.push_back({.name = probe.name,
                    .unit = quantity->unit,
                    .value = measure(probe, *quantity, scene, model, at_start, faults),
                    .is_mean = is_mean(probe, model),
                    .follows_mesh = follows,
                    .mean = follows == dynamics::FollowsMesh::no || !faults.empty()
                                ? decltype(dynamics::Probe::mean){}
                                : measure(of_all, *quantity, scene, model, at_start, faults),
                    .inputs = {},
                    .formula = {},
                    .footing = footing_of(probe, model)});
  }
  return made;
}

}  // namespace nereid::model
