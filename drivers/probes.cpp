#include "drivers/probes.hpp"

#include <algorithm>
#include <cstdio>

#include "dynamics/measure.hpp"

namespace nereid::driver {

namespace {

using dynamics::View;
using Measure = std::function<double(const View&)>;

/// One component of a vector by its name.
template <class Value>
Measure component(const std::string& name, const Vec3& normal, Value&& value) {
  if (name == "magnitude") return [value](const View& view) mutable { return value(view).norm(); };
  if (name == "normal") return [value, normal](const View& view) mutable { return value(view).dot(normal); };
  const int axis = name[0] - 'x';
  return [value, axis](const View& view) mutable -> double { return value(view)(axis); };
}

Measure of_nodes(const std::string& quantity, const std::string& along, const Subset& nodes) {
  const auto vector = [&](auto value) {
    return component(along, Vec3::Zero(), [value, nodes](const View& view) { return value(view, nodes); });
  };
  if (quantity == "displacement") return vector(dynamics::mean_displacement);
  if (quantity == "velocity") return vector(dynamics::mean_velocity);
  if (quantity == "position") return vector(dynamics::mean_position);
  if (quantity == "momentum") return vector(dynamics::momentum);
  if (quantity == "kinetic_energy") return [nodes](const View& view) { return dynamics::kinetic_energy(view, nodes); };
  const int axis = along[0] - 'x';
  if (quantity == "extent") return [nodes, axis](const View& view) { return dynamics::extent(view, nodes, axis); };
  return [nodes, axis](const View& view) { return dynamics::radius(view, nodes, axis); };
}

/// Places of the interfaces of a contact: one, or two passes with the sides exchanged.
std::vector<std::size_t> passes(const dynamics::Model& model, const std::string& contact) {
  std::vector<std::size_t> found;
  for (std::size_t c = 0; c < model.interfaces.size(); ++c)
    if (model.interfaces[c].name == contact || model.interfaces[c].name == contact + "_back") found.push_back(c);
  return found;
}

/// Gap and area of the surface with the apexes; pressures of two passes act together.
Measure of_contact(const std::string& quantity, const std::vector<std::size_t>& passes) {
  if (quantity == "gap")
    return [passes](const View& view) { return dynamics::contact_state(view, passes[0]).least_gap; };
  if (quantity == "contact_area")
    return [passes](const View& view) { return dynamics::contact_state(view, passes[0]).area; };
  return [passes](const View& view) {
    double sum = 0;
    for (const std::size_t pass : passes) sum += dynamics::contact_state(view, pass).largest_pressure;
    return sum;
  };
}

/// On the surface with the apexes: of a second pass it is what pushes back.
Vec3 force_on_apexes(const View& view, const std::vector<std::size_t>& passes) {
  Vec3 sum = dynamics::contact_force(view, passes[0]);
  for (std::size_t p = 1; p < passes.size(); ++p) sum -= dynamics::contact_force(view, passes[p]);
  return sum;
}

Measure of_body(const input::ProbeOptions& probe, const Scene& scene) {
  std::vector<std::size_t> blocks;  // a body from a file may have several regions
  bool measured = true;
  const std::string& name = probe.quantity.name;
  for (std::size_t b = 0; b < scene.model.blocks.size(); ++b) {
    const std::string& region = element::name(scene.model.blocks[b]);
    if (region != probe.of && region.rfind(probe.of + ".", 0) != 0) continue;
    blocks.push_back(b);
    const auto fields = element::fields(scene.model.blocks[b], scene.state.x, scene.state.blocks[b]);
    measured = measured && std::any_of(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
  }
  if (!measured) probe.at.fault("quantity", "'quantity' = " + name + ": the material of " + probe.of + " has no such variable");
  const auto take = probe.largest ? dynamics::Take::largest : dynamics::Take::mean;
  return [=, row = probe.component](const View& view) { return dynamics::of_body(view, blocks, name, row, take); };
}

Measure of_source(const input::ProbeOptions& probe, const Scene& scene) {
  const std::string& along = probe.quantity.components[static_cast<std::size_t>(probe.component)];
  const auto here = [&](const auto& one) { return one.name == probe.of; };
  const dynamics::Model& model = scene.model;
  const auto interfaces = passes(model, probe.of);
  const auto rigid = std::find_if(model.rigid_planes.begin(), model.rigid_planes.end(), here);
  const auto plane = std::find_if(model.constraints.planes.begin(), model.constraints.planes.end(), here);
  Vec3 normal = Vec3::Zero();
  if (rigid != model.rigid_planes.end()) normal = rigid->normal;
  if (plane != model.constraints.planes.end()) normal = plane->normal;
  if (along == "normal" && normal.isZero(0))
    probe.at.fault("component", "'component' = normal: " + probe.of + " is no plane and has no normal");
  if (!interfaces.empty())
    return component(along, normal, [interfaces](const View& view) { return force_on_apexes(view, interfaces); });
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    if (load::name(model.loads[l]) == probe.of && load::is_spring(model.loads[l]))
      return component(along, normal, [l](const View& view) -> Vec3 { return view.now.loads[l].force.col(0); });
  return component(along, normal, [source = dynamics::source_of(model, probe.of), memory = dynamics::ProbeMemory{}](const View& view) mutable {
    const Vec3 force = dynamics::mean_force(view, source, memory);
    ++memory.samples;
    return force;
  });
}

std::string reason(const input::StopOptions& stop, const std::string& unit, double value) {
  char text[200];
  std::snprintf(text, sizeof text, "%s is %.6g %s, %s %.6g %s", stop.probe.c_str(), value, unit.c_str(),
                stop.above ? "above" : "below", stop.value, unit.c_str());
  return text;
}

}  // namespace

void Seen::see(double now, double t) {
  last = now;
  if (!(now <= largest) && now == now) largest = now, time_of_largest = t;
  if (!(now >= smallest) && now == now) smallest = now, time_of_smallest = t;
}

Measure measure(const input::ProbeOptions& probe, const Scene& scene) {
  const input::Measurable& quantity = probe.quantity;
  const auto& names = quantity.components;
  switch (quantity.of) {
    case input::Of::body: return of_body(probe, scene);
    case input::Of::source: return of_source(probe, scene);
    case input::Of::contact: return of_contact(quantity.name, passes(scene.model, probe.of));
    case input::Of::nodes: break;
  }
  return of_nodes(quantity.name, names.empty() ? "x" : names[static_cast<std::size_t>(probe.component)],
                  mesh::node_set(scene.model.mesh, probe.of));
}

void add_probes(const std::vector<input::ProbeOptions>& probes, const std::vector<input::StopOptions>& stops, Scene& scene) {
  const auto seen = std::make_shared<std::vector<Seen>>(probes.size());
  std::vector<std::string> names, units;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    names.push_back(probes[p].name);
    units.push_back(input::si_unit(probes[p].quantity.dimension));
    scene.probes.push_back({names[p], units[p], [seen, p, value = measure(probes[p], scene)](const View& view) {
                              const double now = value(view);
                              (*seen)[p].see(now, view.now.t);
                              return now;
                            }});
  }
  scene.results = [seen, names, units] {
    std::vector<output::Result> results;
    for (std::size_t p = 0; p < names.size(); ++p) {
      const Seen& one = (*seen)[p];
      results.push_back({names[p] + "_last", one.last, units[p]});
      results.push_back({names[p] + "_largest", one.largest, units[p]});
      results.push_back({names[p] + "_largest_at", one.time_of_largest, "s"});
      results.push_back({names[p] + "_smallest", one.smallest, units[p]});
      results.push_back({names[p] + "_smallest_at", one.time_of_smallest, "s"});
    }
    return results;
  };
  if (stops.empty()) return;
  scene.until = [seen, names, units, stops](const View& view) -> std::string {
    for (const input::StopOptions& stop : stops) {
      const auto p = static_cast<std::size_t>(std::find(names.begin(), names.end(), stop.probe) - names.begin());
      const double now = (*seen)[p].last;
      if (view.now.t >= stop.after && (stop.above ? now > stop.value : now < stop.value)) return reason(stop, units[p], now);
    }
    return "";
  };
}

}  // namespace nereid::driver
