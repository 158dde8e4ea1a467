#include <algorithm>
#include <optional>

#include "base/words.hpp"
#include "input/expression.hpp"
#include "input/readers.hpp"
#include "input/table.hpp"
#include "model/values.hpp"

namespace nereid::input {

namespace {

/// Density and the constants of Hooke's law, which every law has.
material::Elastic read_elasticity(const Section& section) {
  return {.density = section.quantity("density", dim::density, positive),
          .young = section.quantity("young", dim::stress, positive),
          .poisson = section.number("poisson", model::range::poisson)};
}

/// All but the yield stress, which other laws have too.
material::JohnsonCook read_johnson_cook(const Section& section) {
  material::JohnsonCook flow{};
  flow.hardening = section.quantity("hardening_coefficient", dim::stress, not_negative);
  flow.hardening_exponent = section.number("hardening_exponent", model::range::hardening_exponent);
  flow.rate_coefficient = section.number("rate_coefficient", model::range::share);
  flow.reference_rate = section.quantity_or("reference_rate", 1, dim::frequency, positive);
  flow.thermal_exponent = section.number("thermal_exponent", model::range::thermal_exponent);
  flow.reference_temperature = section.quantity("reference_temperature", dim::temperature, not_negative);
  flow.melting_temperature = section.quantity("melting_temperature", dim::temperature, positive);
  flow.specific_heat = section.quantity("specific_heat", dim::specific_heat, positive);
  flow.heat_share = section.number_or("taylor_quinney", 0.9, model::range::share);
  flow.temperature = section.quantity_or("temperature", flow.reference_temperature, dim::temperature, not_negative);
  return flow;
}

/// A curve of true stress over plastic strain from a table, as in "steel.csv" or "steel.csv:slow"; empty after a fault.
material::MeasuredCurve read_measured_curve(const Section& section) {
  material::MeasuredCurve curve;
  const std::string name = section.word("table");
  const std::optional<Table> table = name.empty() ? std::nullopt : read_table(section, "table", name);
  if (!table) return curve;
  const auto wrong = [&](const std::string& why) { section.fault("table", quote(name) + ": " + why); };
  if (!(table->of_argument == dim::none))
    wrong("the first column has the dimension [" + describe(table->of_argument) + "]: expected the plastic strain, a plain number");
  else if (!(table->of_value == dim::stress))
    wrong("its values have the dimension [" + describe(table->of_value) + "]: expected a stress, for example 'stress [MPa]'");
  else if (const std::string said = model::wrong_with(material::MeasuredCurve{0, table->argument, table->value}); !said.empty())
    wrong(said);
  curve.strain = table->argument, curve.stress = table->value;
  return curve;
}

/// `curve: {kind: measured | voce | ludwik | swift, ...}` and optional `cowper_symonds: {rate, exponent}`.
material::HardeningCurve read_hardening_curve(const Section& law) {
  using Kind = material::HardeningCurve::Kind;
  material::HardeningCurve flow;
  const Section curve = law.section("curve");
  const std::string kind = curve.choice("kind", {"measured", "voce", "ludwik", "swift"});
  const bool measured = kind == "measured", voce = kind == "voce", swift = kind == "swift";
  flow.kind = measured ? Kind::measured : voce ? Kind::voce : swift ? Kind::swift : Kind::ludwik;
  const double yield = curve.when(!measured && !swift).quantity("yield", dim::stress, positive);
  const double growth = curve.when(!measured).quantity("growth", dim::stress, not_negative);
  const double exponent = curve.when(!measured).number("exponent", voce ? positive : model::range::hardening_exponent);
  const double offset = curve.when(swift).number("offset", positive);
  if (!measured) flow.growth = growth, flow.exponent = exponent;
  if (!measured && !swift) flow.yield = yield;
  if (swift) flow.offset = offset;
  const Section by_table = curve.when(measured);
  if (by_table.has("rates")) {
    for (const Section& one : by_table.list("rates", 2)) {
      const double rate = one.quantity("rate", dim::frequency, positive);
      if (!flow.curves.empty() && !(rate > flow.curves.back().rate))
        one.fault("rate", "'rate' does not grow: expected more than before it");
      flow.curves.push_back(read_measured_curve(one));
      flow.curves.back().rate = rate;
    }
    if (by_table.has("table")) by_table.fault("table", "'table' and 'rates' are two ways to give the curve: give one of them");
  } else {
    const material::MeasuredCurve only = read_measured_curve(by_table);
    if (measured) flow.curves = {only};
  }
  if (!law.has("cowper_symonds")) return flow;
  const Section cowper = law.section("cowper_symonds");
  flow.cowper_rate = cowper.quantity("rate", dim::frequency, positive);
  flow.cowper_exponent = cowper.number("exponent", model::range::cowper_exponent);
  if (flow.curves.size() > 1)
    law.fault("cowper_symonds", "'cowper_symonds' and curves at several 'rates' are two effects of the rate: give one of them");
  return flow;
}

/// Which bodies a law is read for.
enum class For { solids, plates, solids_or_fluids };

const std::vector<std::string> solid_laws{"elastic", "neo_hookean", "j2_bilinear", "j2_curve", "johnson_cook"};
const std::vector<std::string> fluid_laws{"linear_fluid", "mie_gruneisen", "ideal_gas"};

/// The lowest pressure of a liquid. [Pa]
double read_cutoff(const Section& section) { return section.quantity_or("cutoff", 0, dim::stress); }

element::AnyLaw read_fluid_law(const Section& section, const std::string& kind) {
  const double density = section.quantity("density", dim::density, positive);
  if (kind == "ideal_gas")
    return material::IdealGas{.density = density, .gamma = section.number("gamma", model::range::adiabatic), .pressure = 0};
  const bool by_shocks = kind == "mie_gruneisen";
  const bool by_speed = by_shocks || section.has("sound_speed");
  if (!by_shocks && by_speed && section.has("bulk_modulus"))
    section.fault("bulk_modulus", "'bulk_modulus' and 'sound_speed' say the same of a linear fluid: give one of them");
  const double speed = section.when(by_speed).quantity("sound_speed", dim::speed, positive);
  const double modulus = section.when(!by_speed).quantity("bulk_modulus", dim::stress, positive);
  const double slope = section.when(by_shocks).number("slope", model::range::shock_slope);
  const double gamma = section.when(by_shocks).number("gamma", not_negative);
  const double cutoff = read_cutoff(section);
  if (by_shocks) return material::MieGruneisen{density, speed, slope, gamma, cutoff};
  return material::LinearFluid{density, by_speed ? density * speed * speed : modulus, cutoff};
}

element::AnyLaw read_law(const Section& section, For bodies) {
  std::vector<std::string> kinds = solid_laws;
  if (bodies == For::solids_or_fluids) kinds.insert(kinds.end(), fluid_laws.begin(), fluid_laws.end());
  const std::string kind = section.choice("kind", kinds);
  if (std::find(fluid_laws.begin(), fluid_laws.end(), kind) != fluid_laws.end()) return read_fluid_law(section, kind);
  const bool of_plates = bodies == For::plates;
  const bool bilinear = kind == "j2_bilinear", hot = kind == "johnson_cook", curved = kind == "j2_curve";
  const bool refused = of_plates && kind == "neo_hookean";
  static_assert(!material::PlateLaw<material::NeoHookean>);
  if (refused)  // its constants are not missed
    section.fault("kind", model::plates_may_have_other_laws);
  const auto [density, young, poisson] = read_elasticity(section);
  const double yield = section.when(bilinear || hot).quantity("yield", dim::stress, positive);
  const Section if_bilinear = section.when(bilinear);
  const double tangent = if_bilinear.quantity("tangent", dim::stress, not_negative);
  const std::string hardening = if_bilinear.choice_or("hardening", "isotropic", {"isotropic", "kinematic", "mixed"});
  const double share = if_bilinear.when(hardening == "mixed").number("isotropic_share", model::range::share);
  material::JohnsonCook flow = read_johnson_cook(section.when(hot));
  flow.yield = yield;
  if (hot) {
    if (section.sound() && !(flow.reference_temperature < flow.melting_temperature))
      section.fault_between({"melting_temperature", "reference_temperature"},
                            "'melting_temperature' must be above 'reference_temperature'");
    return material::J2JohnsonCook{density, young, poisson, flow};
  }
  const Section if_curved = section.when(curved);
  if (curved || section.has("curve") || section.has("cowper_symonds")) {
    const material::HardeningCurve curve = read_hardening_curve(if_curved);
    if (curved) return material::J2Curve{density, young, poisson, curve};
  }
  if (kind == "neo_hookean") return material::NeoHookean{density, young, poisson};
  if (!bilinear) return material::Elastic{density, young, poisson};
  if (section.sound() && !(tangent < young))
    section.fault_between({"tangent", "young"}, "'tangent' must be below 'young': it is the slope of the stress-strain curve beyond yield");
  if (hardening == "isotropic") return material::J2Bilinear{density, young, poisson, {yield, tangent}};
  return material::J2Mixed{density, young, poisson, yield, tangent, hardening == "mixed" ? share : 0.0};
}

}  // namespace

element::AnyLaw read_law(const Section& section) { return read_law(section, For::solids); }

element::AnyLaw read_plate_law(const Section& section) { return read_law(section, For::plates); }

element::AnyLaw read_solid_or_fluid_law(const Section& section) { return read_law(section, For::solids_or_fluids); }

}  // namespace nereid::input
