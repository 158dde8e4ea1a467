#include "input/readers.hpp"

#include <algorithm>

#include "base/words.hpp"
#include "model/values.hpp"

namespace nereid::input {

element::Viscosity read_viscosity(const Section& section) {
  const Section viscosity = section.section_or_empty("viscosity");
  const element::Viscosity usual;
  return {.linear = viscosity.number_or("linear", usual.linear, model::range::linear_viscosity),
          .quadratic = viscosity.number_or("quadratic", usual.quadratic, model::range::quadratic_viscosity)};
}

element::Distortion read_distortion(const Section& section) {
  return {.stiffness = section.number_or("distortion", element::Distortion{}.stiffness, model::range::distortion)};
}

element::Hexahedron::Options read_one_point_options(const Section& section) {
  using element::Hexahedron;
  using Kind = Hexahedron::Hourglass;
  const auto word = section.choice_or("hourglass_kind", "assumed_strain", {"assumed_strain", "stiffness", "viscous"});
  const Kind kind = word == "assumed_strain" ? Kind::assumed_strain : word == "stiffness" ? Kind::stiffness : Kind::viscous;
  const double usual = kind == Kind::assumed_strain ? Hexahedron::usual_assumed
                       : kind == Kind::stiffness    ? Hexahedron::usual_stiffness
                                                    : Hexahedron::usual_viscous;
  return {.hourglass = section.number_or("hourglass", usual, model::range::hourglass),
          .viscosity = read_viscosity(section),
          .hourglass_kind = kind,
          .distortion = read_distortion(section)};
}

element::AnyHexahedronOptions read_hexahedron_options(const Section& section, std::string_view kind_key) {
  const bool full = section.choice_or(kind_key, "one_point", {"one_point", "full"}) == "full";
  const element::Hexahedron::Options one_point = read_one_point_options(section.when(!full));
  if (!full) return one_point;
  return element::FullHexahedron::Options{.viscosity = read_viscosity(section), .distortion = read_distortion(section)};
}

element::Fluid::Options read_fluid_options(const Section& section) {
  element::Fluid::Options options;
  options.hourglass = section.number_or("hourglass", options.hourglass, model::range::hourglass_of_fluids);
  options.viscosity = read_viscosity(section);
  options.distortion.stiffness = section.number_or("distortion", options.distortion.stiffness, model::range::distortion);
  return options;
}

element::Plate::Options read_plate_options(const Section& section) {
  using Inertia = element::Plate::RotaryInertia;
  using Thinning = element::Plate::Thinning;
  element::Plate::Options options;
  options.thickness = section.quantity("thickness", dim::length, positive);
  options.layers = section.count_or("layers", options.layers, 1, element::Plate::most_layers);
  options.rotary_inertia = section.choice_or("rotary_inertia", "scaled", {"scaled", "physical"}) == "scaled"
                               ? Inertia::scaled
                               : Inertia::physical;
  const auto thinning = section.choice_or("thinning", "by_law", {"by_law", "constant", "follows_strain"});
  options.thinning = thinning == "by_law" ? Thinning::by_law : thinning == "constant" ? Thinning::constant : Thinning::follows_strain;
  options.drilling = section.number_or("drilling", options.drilling, model::range::drilling);
  options.viscosity = read_viscosity(section);
  return options;
}

namespace {

bool read_method(const Section& section) { return section.choice_or("method", "multiplier", {"multiplier", "penalty"}) == "multiplier"; }

/// `friction` [-], optional. Where it is not zero, `kinetic_friction` [-] with `friction_decay` [s/m], optional; and, by a penalty,
/// `tangential_penalty` in (0, 1], optional.
contact::Coulomb read_friction(const Section& section, bool multiplier) {
  contact::Coulomb friction;
  friction.coefficient = section.number_or("friction", friction.coefficient, model::range::friction);
  const Section sliding = section.when(friction.coefficient > 0);
  const bool decays = sliding.has("kinetic_friction") || sliding.has("friction_decay");
  const double kinetic = sliding.when(decays).number("kinetic_friction", model::range::friction);
  const double decay = sliding.when(decays).quantity("friction_decay", dim::slowness, positive);
  if (decays) friction.kinetic = kinetic, friction.decay = decay;
  const Section sticking = sliding.when(!multiplier);
  friction.tangential_penalty = sticking.number_or("tangential_penalty", friction.tangential_penalty, model::range::tangential_penalty);
  return friction;
}

}  // namespace

void read_rigid_contact(const Section& section, model::RigidPlane& plane) {
  const bool multiplier = read_method(section);
  plane.method = multiplier ? contact::Method::multiplier : contact::Method::penalty;
  plane.restitution = section.when(multiplier).number_or("restitution", plane.restitution, model::range::restitution);
  const Section by_penalty = section.when(!multiplier);
  const bool given = !multiplier && section.has("penalty");
  plane.penalty_scale = by_penalty.when(!given).number_or("penalty_scale", plane.penalty_scale, positive);
  plane.friction = read_friction(section, multiplier);
  plane.energy_gain_limit = by_penalty.number_or("energy_gain_limit", plane.energy_gain_limit, model::range::energy_gain_limit);
  plane.step_factor = by_penalty.number_or("step_factor", plane.step_factor, model::range::step_factor);
  const double penalty = by_penalty.when(given).quantity("penalty", dim::penalty, positive);
  if (given) plane.penalty = penalty;
}

namespace {

contact::InitialPenetration read_initial_penetration(const Section& section) {
  return section.choice_or("initial_penetration", "refuse", {"refuse", "accept"}) == "accept" ? contact::InitialPenetration::accept
                                                                                              : contact::InitialPenetration::refuse;
}

/// `penalty`, or `penalty_scale`, both optional.
void read_penalty(const Section& section, bool multiplier, dynamics::InterfaceOptions& options) {
  const Section by_penalty = section.when(!multiplier);
  const bool given = !multiplier && section.has("penalty");
  const double penalty = by_penalty.when(given).quantity("penalty", dim::penalty, positive);
  if (given) options.penalty = penalty;
  options.penalty_scale = by_penalty.when(!given).number_or("penalty_scale", options.penalty_scale, positive);
}

/// `heights: nodes | points` of a contact by multipliers. Points have one direction, with a second pass that guards.
void read_heights(const Section& section, bool used, const std::string& usual, dynamics::InterfaceOptions& options) {
  const bool points = section.when(used).choice_or("heights", usual, {"nodes", "points"}) == "points" && used;
  options.heights = points ? contact::Heights::points : contact::Heights::nodes;
  if (points && options.two_passes) section.fault("heights", "points have one direction: leave out 'passes: two'");
}

}  // namespace

dynamics::InterfaceOptions read_solid_interface(const Section& section) {
  return read_solid_interface(section, section.choice_or("kind", "contact", {"contact", "tied"}) == "tied");
}

dynamics::InterfaceOptions read_solid_interface(const Section& section, bool tied) {
  dynamics::InterfaceOptions options;
  options.kind = tied ? contact::InterfaceKind::tied : contact::InterfaceKind::contact;
  const bool multiplier = read_method(section);
  options.method = multiplier ? contact::Method::multiplier : contact::Method::penalty;
  options.restitution = section.when(multiplier && !tied).number_or("restitution", options.restitution, model::range::restitution);
  const bool may_slide = multiplier && tied, slides = section.when(may_slide).flag_or("slides", options.slides);
  options.slides = may_slide && slides;
  const Section by_penalty = section.when(!multiplier);
  read_penalty(section, multiplier, options);
  options.two_passes = section.choice_or("passes", "one", {"one", "two"}) == "two";
  read_heights(section, multiplier && !tied, options.two_passes ? "nodes" : "points", options);
  options.two_passes = options.two_passes || options.heights == contact::Heights::points;
  const bool base_area = by_penalty.choice_or("area", "apex", {"apex", "base"}) == "base";
  options.area = base_area ? contact::Area::base : contact::Area::apex;
  const Section unilateral = section.when(!tied);
  options.edges = unilateral.flag_or("edges", options.edges);
  options.friction = read_friction(unilateral, multiplier);
  if (tied) options.friction = {};
  const Section rubbing = unilateral.when(options.friction.coefficient > 0);
  if (rubbing.choice_or("weights", "consistent", {"consistent", "paper"}) == "paper") options.weights = contact::Weights::paper;
  const Section spring = unilateral.when(!multiplier);
  options.damping_ratio = spring.number_or("damping_ratio", options.damping_ratio, model::range::damping_ratio);
  if (tied) options.damping_ratio = 0;
  options.energy_gain_limit = spring.number_or("energy_gain_limit", options.energy_gain_limit, model::range::energy_gain_limit);
  options.step_factor = spring.number_or("step_factor", options.step_factor, model::range::step_factor);
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  return options;
}

dynamics::InterfaceOptions read_interface(const Section& section) {
  dynamics::InterfaceOptions options = read_solid_interface(section);
  read_contact_height(section, HeightFrom::initial, options);
  return options;
}

HeightFrom read_contact_height(const Section& section, HeightFrom usual, dynamics::InterfaceOptions& options) {
  const Section unilateral = section.when(options.kind == contact::InterfaceKind::contact);
  const bool has_thickness = usual == HeightFrom::thickness;
  std::vector<std::string> words{"initial", "given"};
  if (has_thickness) words.insert(words.begin(), "thickness");
  const std::string word = unilateral.choice_or("contact_height", words.front(), words);
  const bool initial = word == "initial", given = word == "given";
  options.height.from_initial_height = initial;
  options.height.clearance = unilateral.when(initial).quantity_or("clearance", 0, dim::length, not_negative);
  const double height = unilateral.when(given).quantity("height", dim::length, not_negative);
  options.height.given = given ? height : 0;
  options.initial_penetration = read_initial_penetration(unilateral);
  return initial ? HeightFrom::initial : given ? HeightFrom::given : HeightFrom::thickness;
}

dynamics::InterfaceOptions read_automatic_interface(const Section& section) {
  dynamics::InterfaceOptions options;
  const bool multiplier = read_method(section);
  options.method = multiplier ? contact::Method::multiplier : contact::Method::penalty;
  options.restitution = section.when(multiplier).number_or("restitution", options.restitution, model::range::restitution);
  read_penalty(section, multiplier, options);
  read_heights(section, multiplier, "points", options);
  options.edges = section.flag_or("edges", options.edges);
  options.friction = read_friction(section, multiplier);
  const Section spring = section.when(!multiplier);
  options.energy_gain_limit = spring.number_or("energy_gain_limit", options.energy_gain_limit, model::range::energy_gain_limit);
  options.step_factor = spring.number_or("step_factor", options.step_factor, model::range::step_factor);
  options.initial_penetration = read_initial_penetration(section);
  return options;
}

dynamics::Time read_time(const Section& section, bool has_end) {
  dynamics::Time time;
  if (has_end) time.end = section.quantity("end", dim::time, positive);
  else if (section.has("end")) section.fault("end", "'end' follows from the durations of the 'stages': leave it out");
  time.safety = section.number_or("safety", time.safety, model::range::safety);
  time.created_limit = section.number_or("created_limit", time.created_limit, positive);
  time.overlap_limit = section.number_or("overlap_limit", time.overlap_limit, positive);
  time.corner_limit = section.number_or("corner_limit", time.corner_limit, below(1));
  if (section.has("largest_step")) time.largest_step = section.quantity("largest_step", dim::time, positive);
  return time;
}

model::Recording read_recording(const Section& section, double end) {
  model::Recording recording;
  if (section.has("frames_every")) recording.frames = section.quantity("frames_every", dim::time, positive);
  recording.history = section.quantity_or("history_every", model::usual_rows(recording.frames, end), dim::time, positive);
  for (const auto& [key, every] : {std::pair("frames_every", recording.frames), std::pair("history_every", recording.history)}) {
    const std::string said = section.sound() ? model::too_many(key, every, end) : "";
    if (!said.empty()) section.fault(key, said);
  }
  const std::string between = section.sound() ? model::frames_between_rows(recording.frames, recording.history) : "";
  if (!between.empty()) section.fault("frames_every", between);
  recording.full_precision = section.choice_or("precision", "single", {"single", "double"}) == "double";
  recording.all_fields = section.choice_or("fields", "usual", {"usual", "all"}) == "all";
  return recording;
}

Vec3 read_vector(const Section& section, std::string_view key, Dimension dimension) {
  const auto v = section.vector(key, dimension);
  return {v[0], v[1], v[2]};
}

Vec3 read_direction(const Section& section, std::string_view key) {
  const Vec3 v = read_vector(section, key, dim::none);
  const double size = v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (size > 0) return size > 1e-100 && size < 1e100 ? v.normalized() : Vec3(v / size).normalized();  // whose square is a number
  if (size == 0) section.fault(key, quote(key) + " has no direction: its length is zero");  // NaN where it is not used
  return Vec3::UnitZ();
}

}  // namespace nereid::input
