#include "output/dictionary.hpp"

namespace nereid::output {

const std::vector<Described>& described_results() {
  static const std::vector<Described> all{
      // Probes
      {"PROBE_last", "", "Value in the last row.", "scene"},
      {"PROBE_largest", "", "Largest value of all steps.", "scene"},
      {"PROBE_largest_at", "s", "Time of the largest value.", "scene"},
      {"PROBE_smallest", "", "Smallest value of all steps.", "scene"},
      {"PROBE_smallest_at", "s", "Time of the smallest value.", "scene"},
      // Contacts and rigid planes
      {"CONTACT_penalty", "Pa/m", "Penalty of a contact between two surfaces, contact traction over penetration."},
      {"CONTACT_deepest", "m", "Largest penetration of any apex in any step, positive."},
      {"CONTACT_reconnections", "1", "Number of steps in which an apex went to another feature of its base, summed over the apexes."},
      {"CONTACT_lost", "1", "Number of parts of the surface that apexes in contact left over an edge where the base ends or turns by "
       "more than 84 degrees."},
      {"CONTACT_recovered", "1", "Number of apexes that a search found near their base again."},
      {"CONTACT_first_touch", "s", "First step at which both sides touched; absent if they never did."},
      {"CONTACT_last_touch", "s", "Last step at which both sides touched."},
      {"CONTACT_impulse", "N*s", "Magnitude of the impulse on the apexes."},
      {"CONTACT_effective_nodes", "1", "(sum f)^2 / sum f^2 of the forces f on the nodes: number of nodes on which the contact acted "
       "when its force was largest, of every sixteenth step; absent without force."},
      {"PLANE_deepest", "m", "Largest penetration of any node through the rigid plane in any step, positive."},
      {"PLANE_effective_nodes", "1", "(sum f)^2 / sum f^2 of the forces f on the nodes: number of nodes on which the plane acted when "
       "its force was largest, of every sixteenth step."},
      // Bodies
      {"BODY_smallest_corner", "1", "Smallest Jacobian of a corner of an element over that of the reference; a corner at or below 0 is "
       "inverted. Of solids."},
      {"BODY_artificial_fraction", "1", "Largest energy of artificial modes of the elements over the largest internal energy, both at "
       "rows of the history."},
      {"BODY_hourglass_fraction", "1", "The part of hourglass control in `BODY_artificial_fraction`. Of solids."},
      {"BODY_distortion_fraction", "1", "The part of distortion control. Of solids."},
      {"BODY_drilling_fraction", "1", "The part of the spin of nodes about their normals. Of plates."},
      {"BODY_residual_bending_fraction", "1", "The part of bending that the mesh does not resolve. Of plates."},
      // The whole scene
      {"audit_deepest_overlap", "m", "Largest depth by which bodies overlapped at any audit, positive."},
      {"audit_overlap_elements", "1", "Largest growth of an overlap since the start, in elements."},
      {"hourglass_above_neighbours", "1", "Hourglass energy of elements above the mean of their neighbours, over the strain energy; "
       "absent where the strain energy of all looks, twenty or more in a run, is below 1e-4 of the energy of the scene in the mean."},
      {"strain_energy_concentration", "1", "Strain energy of elements above the mean density of their neighbours, over the strain "
       "energy; absent in the same runs."},
      {"viscous_share", "1", "Energy that the viscosity of shocks dissipates, over the energy of the scene."},
      {"plastic_share", "1", "Energy that plasticity dissipates, over the energy of the scene."},
      {"STAGE_began", "s", "Time at which a stage after the first began."},
      {"smallest_step", "s", "Shortest time step of the run."},
      {"largest_step", "s", "Longest time step of the run."},
      // two_blocks
      {"interface_stress_mean", "Pa", "Mean stress between the blocks while they touch; compression is positive.", "two_blocks"},
      {"interface_stress_peak", "Pa", "Largest stress between the blocks in a row; compression is positive.", "two_blocks"},
      {"contact_time", "s", "Time from first to last contact force.", "two_blocks, penalty_oscillator"},
      {"impulse", "N s", "Impulse of the contact on each block, positive.", "two_blocks"},
      {"velocity_A", "m/s", "Mean velocity along x of the block A in the last row.", "two_blocks"},
      {"velocity_B", "m/s", "Mean velocity along x of the block B in the last row.", "two_blocks"},
      // patch_test
      {"stress_error_mean", "1", "Root of the mean square of the relative error of the axial stress of all elements.", "patch_test"},
      {"stress_error_largest", "1", "Largest relative error of the axial stress.", "patch_test"},
      {"pressure_error_mean", "1", "Root of the mean square of the relative error of the contact pressure of all apexes.", "patch_test"},
      {"pressure_error_largest", "1", "Largest relative error of the contact pressure.", "patch_test"},
      // sliding
      {"way", "m", "Displacement of the sole along x in the last row.", "sliding"},
      {"way_in_second_half", "m", "Displacement of the sole along x in the second half of the run.", "sliding"},
      {"speed", "m/s", "Velocity of the block along x in the last row.", "sliding"},
      {"acceleration", "m/s^2", "Mean acceleration of the block along x in the second half of the run.", "sliding"},
      {"normal_force_ripple", "1", "Largest less smallest normal force, over their mean.", "sliding"},
      {"stop_time", "s", "Time at which the block first has no speed along +x; absent if it always has.", "sliding"},
      // cask_drop
      {"settlement_mean", "m", "Largest settlement of the top of the lead, mean over its area; downwards is positive.", "cask_drop"},
      {"time_of_settlement_mean", "s", "Time of that settlement.", "cask_drop"},
      {"settlement_centre", "m", "Largest settlement of the centre of the top; downwards is positive.", "cask_drop"},
      {"time_of_settlement_centre", "s", "Time of that settlement.", "cask_drop"},
      {"bulge", "m", "Largest outward displacement of the cladding; without cladding, of the side of the lead.", "cask_drop"},
      // plug_juncture, shield_plates and slug_impact: upward forces and impulses, and values of the whole structure
      {"closes_GAP", "s", "Time at which the gap closes; absent if it does not.", "plug_juncture, shield_plates, slug_impact"},
      {"impulse_GAP", "N*s", "Upward impulse that is transmitted through the gap.", "plug_juncture, shield_plates, slug_impact"},
      {"peak_force_GAP", "N", "Largest upward force through the gap, mean between two rows.", "plug_juncture, shield_plates, slug_impact"},
      {"root_shear_JUNCTURE", "Pa", "Largest mean shear stress at the root of the shoulder of the plug; upwards is positive.",
       "plug_juncture"},
      {"least_overlap_JUNCTURE", "m", "Least width by which the shoulder lies below the ledge above it.", "plug_juncture"},
      {"velocity_PLATE", "m/s", "Mean upward velocity of the body in the last row.", "plug_juncture, shield_plates"},
      {"momentum_PLATE", "kg m/s", "Upward momentum of the body in the last row.", "plug_juncture, shield_plates"},
      {"kinetic_energy_PLATE", "J", "Kinetic energy of the body in the last row.", "plug_juncture, shield_plates"},
      {"part_of_momentum_PLATE", "1", "Upward momentum of the plate over the momentum that was given to the structure.",
       "plug_juncture, shield_plates"},
      {"largest_rise_PLATE", "m", "Largest upward displacement of the plug, mean over its nodes.", "plug_juncture"},
      {"largest_deflection_PLATE", "m", "Largest upward displacement of the centre of the disc against its rim.", "shield_plates"},
      {"last_deflection_PLATE", "m", "The same in the last row.", "shield_plates"},
      {"speed_of_impact", "m/s", "Largest mean upward velocity of the slug.", "slug_impact"},
      {"plane_pressure", "Pa", "Pressure of a plane impact at that speed, by the shock velocity of the liquid.", "slug_impact"},
      {"peak_mean_pressure", "Pa", "Largest mean pressure on the head, between two rows.", "slug_impact"},
      {"largest_pressure", "Pa", "Largest pressure of any element of the slug.", "slug_impact"},
      {"pressure_of_first_wave", "Pa", "Mean pressure on the head while the first wave goes through the slug; absent with a gas.",
       "slug_impact"},
      {"first_wave_over_plane", "1", "That pressure over `plane_pressure`.", "slug_impact"},
      {"largest_rise_head", "m", "Largest upward displacement of the centre of the head. Of a plate.", "slug_impact"},
      {"time_of_largest_rise_head", "s", "Time of that displacement.", "slug_impact"},
      {"rise_head", "m", "Upward displacement of the centre of the head in the last row. Of a plate.", "slug_impact"},
      {"part_kinetic_PART", "1", "Kinetic energy of slug, head or wall at the end, over the energy of the scene.", "slug_impact"},
      {"part_compression_slug", "1", "Energy stored in the slug by compression and bubbles, over the energy of the scene.", "slug_impact"},
      {"part_viscous_slug", "1", "Energy that the viscosity of shocks dissipated in the slug, over the energy of the scene.",
       "slug_impact"},
      {"part_hourglass_slug", "1", "Energy that dashpots against hourglassing dissipated in the slug, over the energy of the scene.",
       "slug_impact"},
      {"part_elastic_PART", "1", "Elastic energy of head or wall at the end, over the energy of the scene.", "slug_impact"},
      {"part_plastic_PART", "1", "Energy that plasticity dissipated in head or wall, over the energy of the scene.", "slug_impact"},
      // modes
      {"frequency_N", "Hz", "Lowest frequencies, ascending; rigid motions come first and are about zero.", "modes"},
      {"highest_frequency_N", "Hz", "Highest frequencies, descending.", "modes"},
      {"without_stiffness", "1", "Number of rigid motions and mechanisms among the lowest modes.", "modes"},
      {"exact_step", "s", "Longest stable step, by the highest frequency.", "modes"},
      {"voted_step", "s", "Stable step by the limits of the elements, without `safety`.", "modes"},
      {"asymmetry", "1", "Largest difference of the stiffness matrix to its transpose, over its largest entry.", "modes"},
      {"freedoms", "1", "Number of degrees of freedom.", "modes"},
      {"drilling_freedoms", "1", "Number of rotations about normals that have no stiffness and are left out.", "modes"},
      // material_point: the values of the last increment
      {"strain_COMPONENT", "1", "Strain; tension is positive, shear is the tensor component.", "material_point"},
      {"stress_COMPONENT", "Pa", "Stress; tension is positive.", "material_point"},
      {"plastic_strain", "1", "Equivalent plastic strain, never falling.", "material_point"},
      {"temperature", "K", "Temperature of the law `johnson_cook`.", "material_point"},
      {"back_stress_COMPONENT", "Pa", "Centre of the yield surface, a deviator, of kinematic and mixed hardening.", "material_point"},
      {"left_cauchy_green_less_one_COMPONENT", "1", "Left Cauchy-Green tensor less one, of the law `neo_hookean`.", "material_point"},
      {"work_stored", "J/m^3", "Stored energy per volume.", "material_point"},
      {"work_dissipated", "J/m^3", "Dissipated energy per volume.", "material_point"},
      {"rounds_of_newton", "1", "Most iterations of an increment in the search for strains of given stresses.", "material_point"},
      // contact_elements: largest errors of all elements of a kind, over the length of the largest B
      {"KIND_gradient", "1", "Largest error of B against differences of the height, over the length of the largest B.", "contact_elements"},
      {"KIND_force", "1", "Largest net force of an element, over the same.", "contact_elements"},
      {"KIND_moment", "1", "Largest net moment of an element, over the same and the length of the element.", "contact_elements"},
      {"KIND_motion", "1", "Largest error of B after a rotation and a shift of the element, over the same.", "contact_elements"},
      {"KIND_order", "1", "Largest error of B with the nodes of the base in another order, over the same.", "contact_elements"},
      {"KIND_sharpest", "1", "Largest ratio of the longest to the smallest length of an element.", "contact_elements"},
      // penalty_oscillator
      {"peak_force", "N", "Largest contact force of a bounce.", "penalty_oscillator"},
      {"penetration", "m", "Largest penetration of a bounce, positive.", "penalty_oscillator"},
      {"rebound_largest", "1", "Largest speed apart over the speed of approach, of all phases.", "penalty_oscillator"},
      {"rebound_smallest", "1", "Smallest speed apart over the speed of approach, of all phases.", "penalty_oscillator"},
      {"booked_amiss", "1", "Largest difference of the created energy of the account to the energy that was gained, over the energy of "
       "the impact.", "penalty_oscillator"},
      {"momentum_lost", "1", "Largest relative change of the momentum.", "penalty_oscillator"},
      {"voted_step", "s", "Step limit of the contact.", "penalty_oscillator"},
      {"critical_step", "s", "Largest step with which the closed pair stays bounded.", "penalty_oscillator"},
  };
  return all;
}

const std::vector<Described>& described_columns() {
  static const std::vector<Described> all{
      // All runs with steps
      {"time", "s", "Time of the row: the first step after each multiple of `output.history_every`."},
      {"energy_kinetic", "J", "Kinetic energy of all nodes and rigid bodies."},
      {"energy_SOURCE_STORE", "J", "Energy that a source of force holds in one of its stores, less that at the start; positive if it has "
       "taken energy from the nodes."},
      {"energy_SOURCE_LOSS", "J", "Energy that a source of force has dissipated since the start, not negative."},
      {"energy_created_SOURCE", "J", "Work of the source on the nodes, plus its stores and losses, plus the amount by which a store of a "
       "body is below zero: positive is energy from nothing, negative is energy that vanished."},
      {"energy_integration", "J", "Kinetic energy that belongs to central differences and to no source; it is recovered as forces fall."},
      {"energy_residual", "J", "Kinetic energy that no account explains: round-off."},
      // scene
      {"PROBE", "", "The probe of this name; `mean` after the unit marks means since the row before.", "scene"},
      // two_blocks
      {"interface_stress", "Pa", "Mean stress between the blocks since the row before; compression is positive.", "two_blocks"},
      {"velocity_A", "m/s", "Mean velocity of the block A along x.", "two_blocks"},
      {"velocity_B", "m/s", "Mean velocity of the block B along x.", "two_blocks"},
      // patch_test
      {"stress_error", "1", "Root of the mean square of the relative error of the axial stress.", "patch_test"},
      {"pressure_error", "1", "Root of the mean square of the relative error of the contact pressure.", "patch_test"},
      {"residual", "1", "Unbalanced forces over all forces.", "patch_test"},
      // sliding
      {"way", "m", "Mean displacement of the sole along x.", "sliding"},
      {"speed", "m/s", "Mean velocity of the block along x.", "sliding"},
      {"normal_force", "N", "Force of the base on the block along its normal; pressing is positive.", "sliding"},
      {"friction_force", "N", "Force of the base on the block along x.", "sliding"},
      // cask_drop
      {"settlement_mean", "m", "Settlement of the top of the lead, mean over its area; downwards is positive.", "cask_drop"},
      {"settlement_centre", "m", "Settlement of the centre of the top; downwards is positive.", "cask_drop"},
      {"floor_force", "N", "Upward force of the floor, mean since the row before.", "cask_drop"},
      {"floor_impulse", "N s", "Upward impulse of the floor.", "cask_drop"},
      {"bulge", "m", "Largest outward displacement of the cladding; without cladding, of the side of the lead.", "cask_drop"},
      // plug_juncture, shield_plates and slug_impact: values of the part that is modelled
      {"force_GAP", "N", "Force along z on the apexes below the gap, mean since the row before; negative pushes them down.",
       "plug_juncture, shield_plates, slug_impact"},
      {"gap_JUNCTURE", "m", "Smallest gap between shoulder and ledge; negative in contact.", "plug_juncture"},
      {"velocity_PLATE", "m/s", "Mean upward velocity of the body.", "plug_juncture, shield_plates, slug_impact"},
      {"momentum_PLATE", "kg m/s", "Upward momentum of the body.", "plug_juncture, shield_plates, slug_impact"},
      {"kinetic_energy_PLATE", "J", "Kinetic energy of the body.", "plug_juncture, shield_plates, slug_impact"},
      {"rise_PLATE", "m", "Mean upward displacement of the plug; of the head in slug_impact that of its centre.",
       "plug_juncture, slug_impact"},
      {"hold_force", "N", "Force along z that holds the flange, mean since the row before.", "plug_juncture"},
      {"root_force_JUNCTURE", "N", "Force along z of the plug on its shoulder, mean since the row before.", "plug_juncture"},
      {"overlap_JUNCTURE", "m", "Width by which the shoulder lies below the ledge above it, where it is least.", "plug_juncture"},
      {"deflection_PLATE", "m", "Upward displacement of the centre of the disc against its rim.", "shield_plates"},
      {"largest_pressure_slug", "Pa", "Largest pressure of the elements of the slug; compression is positive.", "slug_impact"},
      {"void_fraction_slug", "1", "Mean part of the volume of the slug that bubbles have.", "slug_impact"},
      {"gap", "m", "Smallest gap between slug, or gas, and head; negative in contact.", "slug_impact"},
      {"pressure_gas", "Pa", "Mean pressure of the gas.", "slug_impact"},
      {"pressure_of_first_wave", "Pa", "Mean pressure on the head so far, while the first wave goes through the slug.", "slug_impact"},
      // modes
      {"mode", "1", "Number of the mode, from the lowest frequency.", "modes"},
      {"frequency", "Hz", "Frequency of the mode.", "modes"},
      {"residual", "1", "Length of K u - omega^2 M u over that of the highest mode.", "modes"},
      // material_point
      {"time", "s", "Number of segments of the path that are done, with the part of the present one.", "material_point"},
      {"strain_COMPONENT", "1", "Strain; tension is positive, shear is the tensor component.", "material_point"},
      {"stress_COMPONENT", "Pa", "Stress; tension is positive.", "material_point"},
      {"plastic_strain", "1", "Equivalent plastic strain.", "material_point"},
      {"temperature", "K", "Temperature of the law `johnson_cook`.", "material_point"},
      {"back_stress_COMPONENT", "Pa", "Centre of the yield surface, a deviator.", "material_point"},
      {"left_cauchy_green_less_one_COMPONENT", "1", "Left Cauchy-Green tensor less one.", "material_point"},
      {"work_stored", "J/m^3", "Stored energy per volume.", "material_point"},
      {"work_dissipated", "J/m^3", "Dissipated energy per volume.", "material_point"},
      // contact_elements
      {"time", "s", "Number of the element.", "contact_elements"},
      {"base_nodes", "1", "Number of nodes of the base: 3, 2 or 1.", "contact_elements"},
      {"sharpness", "1", "Longest over smallest length of the element.", "contact_elements"},
      {"gradient", "1", "Error of B against differences of the height, over the length of the largest B.", "contact_elements"},
      {"force", "1", "Net force, the same.", "contact_elements"},
      {"moment", "1", "Net moment, the same, and over the length of the element.", "contact_elements"},
      {"motion", "1", "Error of B after a rotation and a shift, the same.", "contact_elements"},
      {"order", "1", "Error of B with the nodes of the base in another order, the same.", "contact_elements"},
      // penalty_oscillator
      {"time", "s", "Time since the start of the bounce with half a phase.", "penalty_oscillator"},
      {"gap", "m", "Height of the apex above contact; negative in contact.", "penalty_oscillator"},
      {"force", "N", "Upward contact force on the apex.", "penalty_oscillator"},
      {"velocity_apex", "m/s", "Upward velocity of the apex.", "penalty_oscillator"},
      {"velocity_base", "m/s", "Mean upward velocity of the nodes of the base.", "penalty_oscillator"},
  };
  return all;
}

const std::vector<Described>& described_fields() {
  static const std::vector<Described> all{
      // Every file
      {"TimeValue", "s", "Time of the frame; of modes the frequency in Hz.", "all, file"},
      {"points_are_deformed", "1", "1: the points of the file are the positions at its time.", "all, file"},
      {"FIELD [UNIT]", "1", "An array whose name has a field and its SI unit; its value has no meaning.", "all, file"},
      {"BODY", "1", "Two numbers of a body: its number in `body`, and 3 of solids or 2 of plates.", "body, file"},
      {"displacement", "m", "Position less that at the start: points less `displacement` are the positions at the start.", "all, points"},
      // Nodes of bodies
      {"velocity", "m/s", "Velocity of the node.", "body, points"},
      {"contact_force", "N", "Force of all contacts and rigid planes on the node; on round rigid bodies at the node nearest to the point "
       "of contact.", "body, points"},
      {"node_id", "1", "Number of the node, from 0.", "body, points"},
      // Elements of bodies
      {"stress", "Pa", "Cauchy stress in the axes of the scene: XX YY ZZ XY YZ XZ; tension is positive.", "body, cells"},
      {"von_mises", "Pa", "Von Mises stress; of hexahedra with eight points the largest of theirs.", "body, cells"},
      {"pressure", "Pa", "A third of the sum of the normal stresses with the opposite sign; of fluids their pressure. Compression is "
       "positive.", "body, cells"},
      {"strain", "1", "Logarithmic strain in the axes of the scene; tension is positive, shear is the tensor component. With `fields: "
       "all`.", "body, cells"},
      {"plastic_strain", "1", "Equivalent plastic strain.", "body, cells"},
      {"temperature", "K", "Temperature of the law `johnson_cook`.", "body, cells"},
      {"density", "kg/m^3", "Density of a fluid.", "body, cells"},
      {"internal_energy", "J/kg", "Internal energy per mass of a fluid, since the start.", "body, cells"},
      {"void_fraction", "1", "Part of the volume of a liquid that bubbles have.", "body, cells"},
      {"stress_PLACE", "Pa", "Stress of plates at the top or bottom, in the middle, or as the mean through the thickness.", "body, cells"},
      {"von_mises_PLACE", "Pa", "Von Mises stress of plates there; at `membrane` that of the mean stress.", "body, cells"},
      {"pressure_PLACE", "Pa", "Pressure of plates there. With `fields: all`.", "body, cells"},
      {"strain_PLACE", "1", "Strain of plates there. With `fields: all`.", "body, cells"},
      {"plastic_strain_PLACE", "1", "Equivalent plastic strain of plates there.", "body, cells"},
      {"temperature_PLACE", "K", "Temperature of plates there.", "body, cells"},
      {"thickness", "m", "Thickness of plates now, if it changes.", "body, cells"},
      {"body", "1", "Number of the body.", "body, cells"},
      {"part_id", "1", "Number of the block: elements of one kind and one material.", "body, cells"},
      {"element_id", "1", "Number of the element in its block.", "body, cells"},
      // Contact elements: a line from the foot to the apex, and the facet of the base, for each element
      {"part", "1", "0: the line from the foot to the apex. 1: the facet.", "contact, cells"},
      {"interface_id", "1", "Number of the pass: each contact has one or two, and one more of its edges.", "contact, cells"},
      {"kind", "1", "3: apex over a facet. 2: over an edge. 1: over a vertex. 4: two edges that cross. 0: far from the base.",
       "contact, cells"},
      {"base_id", "1", "Number of the facet, or of the edge of the base; -1: far from the base.", "contact, cells"},
      {"apex_node", "1", "Number of the node of the apex; of edges the first node of the edge.", "contact, cells"},
      {"gap", "m", "Distance less the contact height: positive is open, negative is in contact. Far from the base it is the margin of "
       "the search.", "contact, cells"},
      {"contact_pressure", "Pa", "Force of the contact on the node over its tributary area; compression is positive. 0 of edges.",
       "contact, cells"},
      {"shear_traction", "Pa", "Friction force on the node over the same area, not negative; of ties the force along the base.",
       "contact, cells"},
      {"slides", "1", "1: friction acts and the apex slides. 0: it sticks, or there is no friction.", "contact, cells"},
      {"contact_status", "1", "1: in contact. 0: near and open. -1: far from the base.", "contact, cells"},
      {"reconnect_count", "1", "How often the apex went to another feature of its base.", "contact, cells"},
      // Floors and rigid planes
      {"wall_id", "1", "Number of the rigid plane; floors come after them.", "walls, cells"},
      // Elements of a mesh that is refused or warned of
      {"number", "1", "Number of the element, of files that of the cell in the file.", "offenders, cells"},
      {"mesh", "1", "Number of the body at fault, from 0.", "offenders, cells"},
      {"FLAW", "1", "1 on elements with this fault: docs/meshes.md lists them.", "offenders, cells"},
  };
  return all;
}

const std::vector<Described>& described_summary() {
  static const std::vector<Described> all{
      // How the run ended
      {"driver", "", "Name of the program."},
      {"ending.word", "", "How the run ended: reached_end, stopped_by_condition, relaxed, interrupted, or what stopped it."},
      {"ending.reason", "", "Why a run ended before its end: the condition of `stop` that was met, or what went wrong."},
      {"ending.time", "s", "Time at the end."},
      {"ending.block", "", "The body whose element stopped the run, or null."},
      {"ending.element", "", "The element that stopped the run, or null."},
      // Answers
      {"results", "", "All results, each with value and unit."},
      {"overlaps", "", "Pairs of bodies that overlapped: bodies, contacts, deepest [m], elements [1], at_start [m], place [m], time [s]."},
      {"touched", "", "Pairs that touched: contact, sides, first_touch [s], last_touch [s], impulse [N*s] on the first side."},
      // The ledger
      {"ledger.initial_kinetic", "J", "Kinetic energy at the start."},
      {"ledger.initial_available", "J", "The part of it that the scene can lose."},
      {"ledger.initial_stored", "J", "Energy that all stores held at the start."},
      {"ledger.external_work", "J", "Most work that came in from outside at any time so far."},
      {"ledger.energy_floor", "J", "Least energy that created energy is compared with."},
      {"ledger.energy_scale", "J", "Energy that created energy is compared with."},
      {"ledger.kinetic", "J", "Kinetic energy at the end."},
      {"ledger.integration", "J", "Kinetic energy that belongs to central differences and to no source."},
      {"ledger.integration_kept", "J", "Part of the integration energy that is not recovered."},
      {"ledger.integration_kept_relative", "1", "The same over the energy scale, where it was largest."},
      {"ledger.integration_swing_relative", "1", "Largest integration energy at any time, over the energy scale."},
      {"ledger.energy_residual", "J", "Kinetic energy that no account explains: round-off."},
      {"ledger.initial_momentum", "kg m/s", "Momentum at the start."},
      {"ledger.momentum", "kg m/s", "Momentum at the end."},
      {"ledger.momentum_residual", "kg m/s", "Momentum that no impulse explains: round-off."},
      {"ledger.initial_angular_momentum", "kg m2/s", "Angular momentum about the origin at the start."},
      {"ledger.angular_momentum", "kg m2/s", "Angular momentum about the origin at the end."},
      {"ledger.angular_momentum_residual", "kg m2/s", "Angular momentum that no impulse explains: round-off."},
      {"ledger.accounts.SOURCE.kind", "", "What makes the force: block (of a body), interface, rigid_plane, a plane, a load, spring, "
       "relaxation or gravity."},
      {"ledger.accounts.SOURCE.work", "J", "Work on the nodes since the start: positive speeds them up."},
      {"ledger.accounts.SOURCE.stored.STORE", "J", "What it holds, less that at the start."},
      {"ledger.accounts.SOURCE.dissipated.LOSS", "J", "What it has dissipated."},
      {"ledger.accounts.SOURCE.created", "J", "Work plus stored plus dissipated, plus the amount by which a store of a body "
       "is below zero: positive is energy from nothing."},
      {"ledger.accounts.SOURCE.created_relative", "1", "The same over the energy scale."},
      {"ledger.accounts.SOURCE.passed", "J", "Sum over the steps of the magnitude of its work."},
      {"ledger.accounts.SOURCE.created_of_passed", "1", "Created energy, less what the last steps may make good, over that, where it "
       "was largest, with its sign."},
      {"ledger.accounts.SOURCE.created_by_reconnection", "J", "The part of created energy of steps in which an apex changed its base."},
      {"ledger.accounts.SOURCE.impulse", "N s", "Impulse on the nodes."},
      {"ledger.accounts.SOURCE.angular_impulse", "N m s", "Angular impulse on the nodes about the origin."},
      // Cost
      {"cost.elements", "", "Number of elements."},
      {"cost.steps", "", "Number of steps."},
      {"cost.element_updates", "", "Number of updates of elements that were not rigid."},
      {"cost.wall_seconds", "", "Seconds of the run on the clock."},
      {"cost.nanoseconds_per_element_update", "", "Wall time of one element update, in nanoseconds."},
      {"cost.threads", "", "Number of threads."},
      {"cost.frames", "", "Number of frames."},
      {"cost.frames_every", "s", "Time between frames."},
      {"cost.contact", "", "Contact by multipliers: steps, apexes, conditions and iterations, seconds, and seconds of its stages; absent "
       "without it."},
      // Where the run comes from
      {"provenance.version", "", "Version of the program."},
      {"provenance.commit", "", "Commit of the source."},
      {"provenance.compiler", "", "Compiler."},
      {"provenance.flags", "", "Its flags."},
      {"provenance.build_type", "", "Kind of build."},
      {"provenance.native", "", "Whether it was built for this processor alone."},
      {"provenance.processor", "", "Processor that ran it."},
      {"provenance.case_path", "", "Path of the case."},
      {"provenance.case_hash", "", "Fingerprint of all values and files of the case."},
      {"provenance.resolved", "", "All values of the case in SI, each with unit and whether it is the default."},
      {"not_used", "", "Keys of the case that its kinds do not use."},
      {"notes", "", "Warnings and notes of the run, each a sentence."},
      {"warnings", "", "Those of the notes that are warnings."},
  };
  return all;
}

}  // namespace nereid::output
