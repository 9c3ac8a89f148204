// Malformed cases: each mends into the base case by undoing one change, and each message is asserted whole.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "casefile/read_case.hpp"

namespace carom::casefile_malformed_test {
namespace {

const std::string base = R"(title = "base"
units = "mm-t-s"
[mesh]
file = "bar.msh"
[materials.steel]
law = "linear_elastic"
E = 210000.0
nu = 0.3
rho = 7.85e-9
[[part]]
name = "bar"
cells = "BAR"
material = "steel"
[[support]]
nodes = "TOP"
velocity = { z = -2.0, function = "ramp" }
[[load]]
gravity = [0.0, 0.0, -9810.0]
[[initial]]
part = "bar"
velocity = [0.0, 0.0, -1000.0]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
stiffness = 1e6
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[scheme]
kind = "newmark"
[time]
end = 1e-3
step = 1e-6
[[probe]]
name = "tip"
point = [0.0, 0.0, 100.0]
quantities = ["displacement"]
[[check]]
quantity = "displacement_z"
place = "tip"
time = 5e-4
value = 1.0
tolerance = 0.01
)";

/// `from` in the base case becomes `to`; the error says `message`.
struct Malformed {
  const char* from;
  const char* to;
  const char* message;
};

// clang-format off
const std::vector<Malformed> malformed{
    {"title = \"base\"",
     "title = \"base",
     "c.toml:1:14: found a syntax error (Error while parsing string: unescaped control characters other than TAB (U+0009) are explicitly prohibited); expected TOML. Check quotes, brackets and commas here."},
    {"E = 210000.0",
     "E = 210,000.0",
     "c.toml:7:8: found a syntax error (Error while parsing key-value pair: expected a comment or whitespace, saw ','); expected TOML. Numbers have a point, and nothing between thousands: 210000.0, 2.1e5."},
    {"E = 210000.0",
     "E = 210000.0\nE = 1.0",
     "c.toml:8:5: found a syntax error (Error while parsing key-value pair: cannot redefine existing floating-point 'E'); expected TOML. A name may be given once; sections that repeat are written [[name]]."},
    {"[scheme]",
     "[materials.steel]\n[scheme]",
     "c.toml:32:1: found a syntax error (Error while parsing table header: cannot redefine existing table 'materials.steel'); expected TOML. A name may be given once; sections that repeat are written [[name]]."},
    {"end = 1e-3",
     "end = 1e-3 s",
     "c.toml:35:12: found a syntax error (Error while parsing key-value pair: expected a comment or whitespace, saw 's'); expected TOML. Numbers stand without a unit: all are in the system that `units` names."},
    {"title = \"base\"",
     "title = base",
     "c.toml:1:9: found a syntax error (Error while parsing value: could not determine value type); expected TOML. Texts stand in quotes: title = \"base\""},
    {"rho = 7.85e-9",
     "density = 7.85e-9",
     "c.toml:9:1: materials.steel.density: found an unknown key; expected one of law, E, nu, rho, library, checksum. Did you mean rho?"},
    {"stiffness = 1e6",
     "mu = 0.1\nstiffness = 1e6",
     "c.toml:26:1: contact[0].mu: found an unknown key; expected one of name, kind, moment_point, cfc, group, stiffness, stiffness_factor, tangential_stiffness, friction, friction_law, restitution, initial_penetration, depths, pressures, measure, bar_radius, velocity, function, mass, inertia, products_of_inertia, centre_of_mass, rigidity, blocked, blocked_turns, blocked_at, angular_velocity, centre_of_rotation, angular_function, point, normal. Did you mean friction?"},
    {"rho = 7.85e-9",
     "Rho = 7.85e-9",
     "c.toml:9:1: materials.steel.Rho: found an unknown key; expected one of law, E, nu, rho, library, checksum. Did you mean rho?"},
    {"[[contact]]",
     "[[contacts]]",
     "c.toml:22:3: contacts: found an unknown key; expected one of title, units, mesh, materials, part, point_mass, spring, rigid_body, equation, erosion, support, load, initial_state, initial, contact, functions, scheme, time, stage, solver, guards, output, probe, check, exact. Did you mean contact?"},
    {"stiffness = 1e6",
     "stifness = 1e6",
     "c.toml:26:1: contact[0].stifness: found an unknown key; expected one of name, kind, moment_point, cfc, group, stiffness, stiffness_factor, tangential_stiffness, friction, friction_law, restitution, initial_penetration, depths, pressures, measure, bar_radius, velocity, function, mass, inertia, products_of_inertia, centre_of_mass, rigidity, blocked, blocked_turns, blocked_at, angular_velocity, centre_of_rotation, angular_function, point, normal. Did you mean stiffness?"},
    {"kind = \"newmark\"",
     "kind = \"newmark\"\nbetta = 0.25",
     "c.toml:34:1: scheme.betta: found an unknown key; expected one of kind, enforcement, beta, gamma, penetration, mass, layers, redistribution. Did you mean beta?"},
    {"velocity = { z = -2.0,",
     "velocity = { w = -2.0,",
     "c.toml:16:14: support[0].velocity.w: found an unknown key; expected one of x, y, z, function. Did you mean x?"},
    {"[time]",
     "[time]\n\"two words\" = 1",
     "c.toml:35:1: time.\"two words\": found an unknown key; expected one of end, step, fixed, event_tolerance"},
    {"title = \"base\"",
     "title = 5",
     "c.toml:1:9: title: found 5; expected a text in quotes"},
    {"E = 210000.0",
     "E = \"210000.0\"",
     "c.toml:7:5: materials.steel.E: found \"210000.0\"; expected a number > 0 in MPa. Write the number without quotes."},
    {"E = 210000.0",
     "E = true",
     "c.toml:7:5: materials.steel.E: found true; expected a number > 0 in MPa"},
    {"E = 210000.0",
     "E = 2001-01-01",
     "c.toml:7:5: materials.steel.E: found a date or time; expected a number > 0 in MPa"},
    {"normal = [0.0, 0.0, 1.0]",
     "normal = \"z\"",
     "c.toml:28:10: contact[0].normal: found \"z\"; expected three numbers [x, y, z]"},
    {"normal = [0.0, 0.0, 1.0]",
     "normal = [0.0, 1.0]",
     "c.toml:28:10: contact[0].normal: found a list of 2 values; expected three numbers [x, y, z]"},
    {"normal = [0.0, 0.0, 1.0]",
     "normal = [0.0, 0.0, \"1\"]",
     "c.toml:28:21: contact[0].normal[2]: found \"1\"; expected a number. Write the number without quotes."},
    {"step = 1e-6",
     "step = 1e-6\nfixed = \"yes\"",
     "c.toml:37:9: time.fixed: found \"yes\"; expected true or false"},
    {"[[part]]",
     "[part]",
     "c.toml:10:1: part: found a table of 3 keys; expected sections [[part]]. Write the name in double brackets, once for each entry."},
    {"[materials.steel]",
     "[[materials]]",
     "c.toml:5:1: materials: found a list of 1 value; expected sections [materials.NAME]"},
    {"[[probe]]",
     "[solver]\nmax_contact_iterations = 2.5\n[[probe]]",
     "c.toml:38:26: solver.max_contact_iterations: found 2.5; expected an integer >= 1"},
    {"[mesh]\nfile = \"bar.msh\"",
     "mesh = \"bar.msh\"",
     "c.toml:3:8: mesh: found \"bar.msh\"; expected a table of keys"},
    {"quantities = [\"displacement\"]",
     "quantities = \"displacement\"",
     "c.toml:40:14: probe[0].quantities: found \"displacement\"; expected a list of some of \"displacement\", \"velocity\", \"acceleration\", \"stress\", \"von_mises\", \"principal_stress\", \"maximum_shear_stress\", \"pressure\", \"stress_at_nodes\", \"strain\", \"strain_rate\", \"strain_energy_density\", \"equivalent_plastic_strain\", \"temperature_rise\", \"damage\", \"largest_plastic_rate\", \"equivalent_plastic_strain_at_nodes\", \"contact_force\", \"contact_pressure\", \"contact_gap\", \"contact_slip_rate\", \"contact_slip\", \"contact_damage\", \"section_force\", \"reaction\", \"reaction_moment\", \"local_acceleration\", \"mass\", \"momentum\", \"kinetic_energy\", \"strain_energy\", \"hourglass_energy\", \"distortion_energy\", \"plastic_energy\", \"hourglass_loss\", \"viscous_loss\", \"largest_von_mises\", \"largest_principal_stress\", \"smallest_principal_stress\", \"largest_pressure\", \"largest_plastic_strain\", a variable that points remember (docs/material_laws.md, or of a library's law). Did you mean \"displacement\"?"},
    {"rho = 7.85e-9",
     "rho = -7.85e-9",
     "c.toml:9:7: materials.steel.rho: found -7.85e-09; expected a number > 0 in t/mm3"},
    {"rho = 7.85e-9",
     "rho = 0",
     "c.toml:9:7: materials.steel.rho: found 0; expected a number > 0 in t/mm3"},
    {"nu = 0.3",
     "nu = 0.5",
     "c.toml:8:6: materials.steel.nu: found 0.5; expected a number > -1 and < 0.5. Poisson's ratio of a material lies between 0 and 0.5. At 0.5 a body cannot change its volume at all, and its bulk modulus is infinite: take 0.499 with formulation = \"mean_dilatation\"."},
    {"nu = 0.3",
     "nu = -1",
     "c.toml:8:6: materials.steel.nu: found -1; expected a number > -1 and < 0.5. Poisson's ratio of a material lies between 0 and 0.5. At 0.5 a body cannot change its volume at all, and its bulk modulus is infinite: take 0.499 with formulation = \"mean_dilatation\"."},
    {"E = 210000.0",
     "E = inf",
     "c.toml:7:5: materials.steel.E: found inf; expected a number > 0 in MPa"},
    {"E = 210000.0",
     "E = nan",
     "c.toml:7:5: materials.steel.E: found nan; expected a number > 0 in MPa"},
    {"velocity = [0.0, 0.0, -1000.0]",
     "velocity = [0.0, 0.0, nan]",
     "c.toml:21:23: initial[0].velocity[2]: found nan; expected a number in mm/s"},
    {"end = 1e-3",
     "end = 0",
     "c.toml:35:7: time.end: found 0; expected a number > 0 in s"},
    {"step = 1e-6",
     "step = 2e-3",
     "c.toml:36:8: time.step: found 0.002; expected a step of at most time.end = 0.001"},
    {"kind = \"newmark\"",
     "kind = \"newmark\"\ngamma = 0.4",
     "c.toml:34:9: scheme.gamma: found 0.4; expected a number >= 0.5 and <= 1"},
    {"kind = \"newmark\"",
     "kind = \"newmark\"\nbeta = 0.0",
     "c.toml:34:8: scheme.beta: found 0.0; expected a number > 0 and <= 0.5"},
    {"tolerance = 0.01",
     "tolerance = 0",
     "c.toml:46:13: check[0].tolerance: found 0; expected a number > 0"},
    {"[[probe]]",
     "[solver]\nmax_contact_iterations = 0\n[[probe]]",
     "c.toml:38:26: solver.max_contact_iterations: found 0; expected an integer >= 1"},
    {"[[probe]]",
     "[solver]\nmax_contact_iterations = 3000000000\n[[probe]]",
     "c.toml:38:26: solver.max_contact_iterations: found 3000000000; expected an integer of at most 2147483647"},
    {"[[probe]]",
     "[output]\ncurves_every = 0\n[[probe]]",
     "c.toml:38:16: output.curves_every: found 0; expected an integer >= 1"},
    {"stiffness = 1e6",
     "stiffness = 1e6\nfriction = -0.1",
     "c.toml:27:12: contact[0].friction: found -0.1; expected a number >= 0"},
    {"normal = [0.0, 0.0, 1.0]",
     "normal = [0, 0, 0]",
     "c.toml:28:10: contact[0].normal: found a vector of length 0; expected a direction, such as [0, 0, 1]"},
    {"file = \"bar.msh\"",
     "[[mesh.block]]\nsize = [1.0, 0.0, 1.0]\ndivisions = [1, 1, 1]",
     "c.toml:5:14: mesh.block[0].size[1]: found 0.0; expected a number > 0 in mm"},
    {"file = \"bar.msh\"",
     "[[mesh.block]]\nsize = [1.0, 1.0, 1.0]\ndivisions = [1, 1, 0]",
     "c.toml:6:20: mesh.block[0].divisions[2]: found 0; expected an integer >= 1"},
    {"units = \"mm-t-s\"",
     "units = \"mm-t-S\"",
     "c.toml:2:9: units: found \"mm-t-S\"; expected one of \"SI\", \"mm-t-s\", \"mm-kg-ms\". Did you mean \"mm-t-s\"?"},
    {"units = \"mm-t-s\"",
     "units = \"cgs\"",
     "c.toml:2:9: units: found \"cgs\"; expected one of \"SI\", \"mm-t-s\", \"mm-kg-ms\""},
    {"law = \"linear_elastic\"",
     "law = \"linear_elastc\"",
     "c.toml:6:7: materials.steel.law: found \"linear_elastc\"; expected one of \"linear_elastic\", \"st_venant_kirchhoff\", \"neo_hookean\", \"j2_small_strain\", \"j2\", \"johnson_cook\", \"j2_rate_small_strain\", \"j2_rate\", \"swift_small_strain\". Did you mean \"linear_elastic\"?"},
    {"kind = \"newmark\"",
     "kind = \"newmarck\"",
     "c.toml:33:8: scheme.kind: found \"newmarck\"; expected one of \"newmark\", \"hht\", \"wbz\", \"generalized_alpha\", \"bathe\", \"contact_stabilized_newmark\", \"energy_momentum\", \"moreau_jean\", \"nonsmooth_generalized_alpha\", \"central_differences\", \"hulbert_chung\", \"noh_bathe\", \"tchamwa_wielgosz\", \"modified_mass\", \"statics\", \"cd_lagrange\", \"forward_increment\". Did you mean \"newmark\"?"},
    {"kind = \"plane\"",
     "kind = \"plan\"",
     "c.toml:24:8: contact[0].kind: found \"plan\"; expected one of \"interface\", \"plane\", \"sphere\", \"cylinder\", \"box\", \"surface\", \"pair\", \"self\", \"all\", \"stop\", \"tie\". Did you mean \"plane\"?"},
    {"quantities = [\"displacement\"]", "quantities = [\"displacments\"]",
     "c.toml:40:15: probe[0].quantities[0]: found the unknown name \"displacments\"; expected a quantity, or a variable that points remember (displacement, velocity, acceleration, stress, von_mises, principal_stress, maximum_shear_stress, pressure, stress_at_nodes, strain, strain_rate, strain_energy_density, equivalent_plastic_strain, temperature_rise, damage, largest_plastic_rate, equivalent_plastic_strain_at_nodes, contact_force, contact_pressure, contact_gap, contact_slip_rate, contact_slip, contact_damage, section_force, reaction, reaction_moment, local_acceleration). Did you mean \"displacement\"?"},
    {"point = [0.0, 0.0, 100.0]\nquantities = [\"displacement\"]", "part = \"bar\"\nquantities = [\"max_principal_stress\"]",
     "c.toml:40:15: probe[0].quantities[0]: found the unknown name \"max_principal_stress\"; expected a quantity of parts (mass, momentum, kinetic_energy, strain_energy, hourglass_energy, distortion_energy, plastic_energy, hourglass_loss, viscous_loss, largest_von_mises, largest_principal_stress, smallest_principal_stress, largest_pressure, largest_plastic_strain). Did you mean \"largest_principal_stress\"?"},
    {"point = [0.0, 0.0, 100.0]\nquantities = [\"displacement\"]", "part = \"bar\"\nquantities = [\"principal_stress\"]",
     "c.toml:40:15: probe[0].quantities: found \"principal_stress\" of a part; expected one of mass, momentum, kinetic_energy, strain_energy, hourglass_energy, distortion_energy, plastic_energy, hourglass_loss, viscous_loss, largest_von_mises, largest_principal_stress, smallest_principal_stress, largest_pressure, largest_plastic_strain"},
    {"quantities = [\"displacement\"]", "quantities = [\"velocity\", \"velocity\"]",
     "c.toml:40:27: probe[0].quantities[1]: found \"velocity\" a second time; expected each name once"},
    {"velocity = { z = -2.0, function = \"ramp\" }",
     "blocked = [\"x\", \"Z2\"]",
     "c.toml:16:17: support[0].blocked[1]: found \"Z2\"; expected one of \"x\", \"y\", \"z\". Did you mean \"z\"?"},
    {"[mesh]\nfile = \"bar.msh\"\n",
     "",
     "c.toml:1:1: mesh: found nothing; expected a section [mesh]. Add mesh: Where the mesh comes from: a file, structured blocks, or both."},
    {"rho = 7.85e-9\n",
     "",
     "c.toml:5:1: materials.steel.rho: found nothing; expected a number > 0 in t/mm3. Add rho: Density."},
    {"[scheme]\nkind = \"newmark\"\n",
     "",
     "c.toml:1:1: scheme: found nothing; expected a section [scheme]. Add scheme: Time integration and the enforcement of contact."},
    {"kind = \"plane\"\n",
     "",
     "c.toml:22:1: contact[0].kind: found nothing; expected one of \"interface\", \"plane\", \"sphere\", \"cylinder\", \"box\", \"surface\", \"pair\", \"self\", \"all\", \"stop\", \"tie\". Add kind: What touches; decides which of the other keys are taken."},
    {"step = 1e-6\n",
     "",
     "c.toml:34:1: time.step: found nothing; expected a number > 0 in s. Add step: Time step. To begin with, a hundredth of the time that an impact takes; `carom check` says what it is in Courant numbers."},
    {"normal = [0.0, 0.0, 1.0]\n",
     "",
     "c.toml:22:1: contact[0].normal: found nothing; expected three numbers [x, y, z]. Add normal: Direction from the plane to the body; of any length but 0."},
    {"tolerance = 0.01\n",
     "",
     "c.toml:41:1: check[0].tolerance: found nothing; expected a number > 0. Add tolerance: Largest difference, relative to the reference unless absolute = true."},
    {"name = \"bar\"",
     "name = \"\"",
     "c.toml:11:8: part[0].name: found \"\"; expected a text in quotes"},
    {"cells = \"BAR\"\n",
     "",
     "c.toml:10:1: part[0].cells: found nothing; expected a text in quotes. Add cells: Group of cells, or \"all\": all cells of the mesh that the section takes."},
    {"kind = \"plane\"",
     "kind = \"stop\"",
     "c.toml:27:1: contact[0].point: found a key that kind = \"stop\" does not take; expected one of name, kind, moment_point, cfc, group, normal, gap, stiffness, damping, damper. It belongs to kind = \"plane\", \"cylinder\"."},
    {"stiffness = 1e6",
     "stiffness = 1e6\ngap = 0.5",
     "c.toml:27:1: contact[0].gap: found a key that kind = \"plane\" does not take; expected one of name, kind, moment_point, cfc, group, stiffness, stiffness_factor, tangential_stiffness, friction, friction_law, restitution, initial_penetration, depths, pressures, measure, bar_radius, velocity, function, mass, inertia, products_of_inertia, centre_of_mass, rigidity, blocked, blocked_turns, blocked_at, angular_velocity, centre_of_rotation, angular_function, point, normal. It belongs to kind = \"stop\"."},
    {"stiffness = 1e6",
     "stiffness = 1e6\ninertia = [1.0, 1.0, 1.0]",
     "c.toml:27:11: contact[0].inertia: found an inertia without a mass; expected the mass of a free body beside its inertia. Add mass, or remove inertia."},
    {"stiffness = 1e6",
     "stiffness = 1e6\nmass = 1.0\nangular_velocity = [1.0, 1.0, 1.0]",
     "c.toml:28:20: contact[0].angular_velocity: found an angular velocity beside a mass without an inertia; expected the inertia of a free body that turns, or no mass. Add inertia, or remove mass: the rotation is then imposed."},
    {"stiffness = 1e6",
     "stiffness = 1e6\nangular_velocity = [0.0, 0.0, 1.0]",
     "c.toml:27:20: contact[0].angular_velocity: found a rotation without a centre; expected a centre_of_rotation, which only spheres, boxes and cylinders that turn about their own axis have by their shape. Add centre_of_rotation, a point of the axis that it turns about."},
    {"stiffness = 1e6",
     "stiffness = 1e6\nangular_velocity = [0.0, 0.0, 0.0]",
     "c.toml:27:20: contact[0].angular_velocity: found [0, 0, 0], which is no rotation; expected a direction and a rate, as [0, 0, 10]. Remove angular_velocity where the obstacle does not turn."},
    {"stiffness = 1e6",
     "stiffness = 1e6\ncentre_of_rotation = [0.0, 0.0, 0.0]",
     "c.toml:27:22: contact[0].centre_of_rotation: found centre_of_rotation without an angular_velocity; expected an angular_velocity that is imposed. Add angular_velocity, or remove centre_of_rotation."},
    {"stiffness = 1e6",
     "stiffness = 1e6\nmass = 1.0\ninertia = [1.0, 1.0, 1.0]\ncentre_of_mass = [0.0, 0.0, 0.0]\nangular_velocity = [0.0, 0.0, 1.0]\ncentre_of_rotation = [0.0, 0.0, 0.0]",
     "c.toml:31:22: contact[0].centre_of_rotation: found centre_of_rotation of a free body; expected an obstacle without a mass, whose rotation is imposed. A free body turns about its centre_of_mass as forces make it: remove centre_of_rotation, or mass."},
    {"stiffness = 1e6",
     "stiffness = 1e6\nangular_velocity = [0.0, 0.0, 1.0]\ncentre_of_mass = [0.0, 0.0, 0.0]",
     "c.toml:28:18: contact[0].centre_of_mass: found centre_of_mass without an inertia; expected the inertia of a free body that turns. Add mass and inertia, or remove centre_of_mass; an imposed rotation has a centre_of_rotation."},
    {"stiffness = 1e6",
     "stiffness = 1e6\nangular_function = \"ramp\"",
     "c.toml:27:20: contact[0].angular_function: found angular_function without an angular_velocity; expected an angular_velocity that is imposed. Add angular_velocity, or remove angular_function."},
    {"stiffness = 1e6",
     "stiffness = 1e6\nangular_velocity = [0.0, 0.0, 1.0]\ncentre_of_rotation = [0.0, 0.0, 0.0]\nangular_function = \"ramp\"\nfunction = \"ramp\"",
     "c.toml:30:12: contact[0].function: found a function beside an angular_function, without a velocity; expected a velocity that is imposed. Remove one of the two functions, or give velocity."},
    {"stiffness = 1e6",
     "stiffness = 1e6\nangular_velocity = [0.0, 0.0, 1.0]\ncentre_of_rotation = [0.0, 0.0, 0.0]\nangular_function = \"rump\"",
     "c.toml:29:20: contact[0].angular_function: found the unknown name \"rump\"; expected the name of a [functions.NAME] (ramp). Did you mean \"ramp\"?"},
    {"stiffness = 1e6",
     "stiffness = 1e6\nmass = 1.0\ninertia = [1.0, 1.0, 1.0]",
     "c.toml:28:11: contact[0].inertia: found an inertia without a centre of mass; expected a centre_of_mass, which only spheres and boxes have by their shape. Add centre_of_mass."},
    {"kind = \"newmark\"",
     "kind = \"central_differences\"\nbeta = 0.25",
     "c.toml:34:1: scheme.beta: found a key that kind = \"central_differences\" does not take; expected one of kind, enforcement, mass, layers, redistribution, mass_scaling_step, mass_scaling_limit. It belongs to kind = \"newmark\"."},
    {"step = 1e-6",
     "step = 1e-6\nsafety = 0.9",
     "c.toml:37:1: time.safety: found a key that scheme.kind = \"newmark\" does not take; expected one of end, step, fixed, event_tolerance. It belongs to scheme.kind = \"central_differences\", \"hulbert_chung\", \"noh_bathe\", \"tchamwa_wielgosz\", \"modified_mass\", \"cd_lagrange\", \"forward_increment\"."},
    {"[functions.ramp]",
     "[functions.ramp]\nkind = \"step\"",
     "c.toml:31:8: functions.ramp.time: found a list of 2 values; expected a number in s\nc.toml:32:1: functions.ramp.value: found a key that kind = \"step\" does not take; expected one of kind, time, before, after. It belongs to kind = \"table\".\n2 errors"},
    {"[functions.ramp]\ntime = [0.0, 1.0]",
     "[functions.ramp]\nkind = \"step\"\ntime = [0.0, 1.0]\nafter = 1.0",
     "c.toml:31:8: functions.ramp.time: found a list of 2 values; expected a number in s\nc.toml:33:1: functions.ramp.value: found a key that kind = \"step\" does not take; expected one of kind, time, before, after. It belongs to kind = \"table\".\n2 errors"},
    {"[[check]]",
     "[exact]\nsolution = \"bar_on_rigid_wall\"\nstiffness = 1.0\n[[check]]",
     "c.toml:43:1: exact.stiffness: found a key that solution = \"bar_on_rigid_wall\" does not take; expected one of solution, length, area, modulus, density, speed, gap, initial_displacement, axis. It belongs to solution = \"bar_on_penalty_wall\", \"friction_oscillator\"."},
    {"file = \"bar.msh\"",
     "file = \"\"\n[[mesh.block]]\nsize = [1, 1, 1]\ndivisions = [1, 1, 1]",
     "c.toml:4:8: mesh.file: found \"\"; expected the name of a mesh file"},
    {"file = \"bar.msh\"",
     "",
     "c.toml:3:1: mesh: found none of file, block; expected at least one of file, block"},
    {"file = \"bar.msh\"",
     "file = \"\"",
     "c.toml:4:8: mesh.file: found \"\"; expected the name of a mesh file"},
    {"file = \"bar.msh\"",
     "block = []",
     "c.toml:3:1: mesh.block: found no block; expected at least one [[mesh.block]]"},
    {"part = \"bar\"",
     "part = \"bar\"\nnodes = \"all\"",
     "c.toml:20:8: initial[0]: found nodes and part together; expected exactly one of nodes, part"},
    {"velocity = [0.0, 0.0, -1000.0]\n",
     "",
     "c.toml:19:1: initial[0]: found none of displacement, velocity, angular_velocity, velocity_field, drop_height; expected at least one of displacement, velocity, angular_velocity, velocity_field, drop_height"},
    {"velocity = { z = -2.0, function = \"ramp\" }\n",
     "",
     "c.toml:14:1: support[0]: found none of symmetry, blocked, displacement, velocity, acceleration; expected at least one of symmetry, blocked, displacement, velocity, acceleration"},
    {"velocity = { z = -2.0, function = \"ramp\" }",
     "velocity = { function = \"ramp\" }",
     "c.toml:16:12: support[0].velocity: found none of x, y, z; expected at least one of x, y, z"},
    {"value = 1.0\ntolerance",
     "value = 1.0\nreference = \"exact\"\ntolerance",
     "c.toml:46:13: check[0]: found value and reference together; expected exactly one of value, reference"},
    {"value = 1.0\ntolerance",
     "tolerance",
     "c.toml:41:1: check[0]: found none of value, reference; expected exactly one of value, reference"},
    {"gravity = [0.0, 0.0, -9810.0]",
     "force = [1.0, 0.0, 0.0]",
     "c.toml:17:1: load[0].group: found nothing; expected the group of nodes that the force acts on"},
    {"gravity = [0.0, 0.0, -9810.0]",
     "pressure = 1.0",
     "c.toml:17:1: load[0].group: found nothing; expected the group of faces that the pressure acts on"},
    {"gravity = [0.0, 0.0, -9810.0]",
     "gravity = [0.0, 0.0, -9810.0]\ngroup = \"BAR\"",
     "c.toml:19:9: load[0].group: found \"BAR\"; expected no group. Gravity acts on all parts."},
    {"point = [0.0, 0.0, 100.0]\nquan",
     "node = 1\ngroup = \"FOOT\"\nquan",
     "c.toml:40:9: probe[0]: found node and group together; expected exactly one of node, point, group, part"},
    {"velocity = { z = -2.0, function = \"ramp\" }",
     "blocked = [\"z\"]\nvelocity = { z = -2.0 }",
     "c.toml:17:18: support[0].velocity: found component z a second time (also in blocked); expected each component once in a support"},
    {"velocity = { z = -2.0, function = \"ramp\" }",
     "symmetry = \"y\"\nblocked = [\"y\"]",
     "c.toml:17:11: support[0].blocked: found component y a second time (also in symmetry); expected each component once in a support"},
    {"stiffness = 1e6",
     "stiffness = 1e6\nstiffness_factor = 2.0",
     "c.toml:27:20: contact[0].stiffness_factor: found a factor beside a stiffness; expected one of the two. Remove stiffness to have it chosen."},
    {"stiffness = 1e6",
     "restitution = 0.5",
     "c.toml:26:15: contact[0].restitution: found 0.5 with enforcement = \"penalty\"; expected enforcement = \"impulse\" with a restitution. Deformable bodies rebound by their own waves; remove restitution, or take moreau_jean, nonsmooth_generalized_alpha or central_differences."},
    {"stiffness = 1e6",
     "function = \"ramp\"",
     "c.toml:26:12: contact[0].function: found a function without a velocity; expected a velocity that is imposed. Remove function, or give velocity or angular_velocity and no mass."},
    {"kind = \"plane\"\ngroup = \"FOOT\"\nstiffness = 1e6\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]",
     "kind = \"box\"\ngroup = \"FOOT\"\nlower = [0, 0, 0]\nupper = [1, 0, 1]",
     "c.toml:27:9: contact[0].upper: found 0 against a lower of 0; expected larger coordinates than lower, all three"},
    {"kind = \"newmark\"",
     "kind = \"newmark\"\nmass = \"modified\"",
     "c.toml:34:8: scheme.mass: found \"modified\" with scheme newmark and enforcement penalty; expected modified_mass, statics, or newmark, hht, wbz, generalized_alpha or bathe with enforcement = \"lagrange\""},
    {"kind = \"newmark\"",
     "kind = \"hht\"\nalpha = -0.5",
     "c.toml:34:9: scheme.alpha: found -0.5 with scheme hht; expected a number >= -1/3 and <= 0. Below, HHT dissipates less again: choose -1/3, or scheme wbz."},
    {"kind = \"newmark\"",
     "kind = \"newmark\"\nlayers = 2",
     "c.toml:34:10: scheme.layers: found a key of the modified mass; expected it only beside mass = \"modified\". Remove layers, or choose mass = \"modified\"."},
    {"kind = \"newmark\"",
     "kind = \"newmark\"\npenetration = 1e-3",
     "c.toml:34:15: scheme.penetration: found a key of the augmented Lagrangian; expected it only beside enforcement = \"augmented_lagrangian\". Remove it."},
    {"[[probe]]",
     "[[stage]]\nkind = \"bathe\"\nend = 1e-3\nstep = 1e-6\n[[probe]]",
     "c.toml:39:7: stage[0].end: found 0.001; expected a time after 0.001, the end of the stage before. end counts from the start of the run."},
    {"kind = \"plane\"\ngroup = \"FOOT\"\nstiffness = 1e6\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]",
     "kind = \"pair\"\ngroup = \"FOOT\"",
     "c.toml:22:1: contact[0].master: found nothing; expected a text in quotes. Add master: Group of faces, or of bars, of the other body; the coarser or stiffer one."},
    {"stiffness = 1e6",
     "stiffness = 1e6\ntangential_stiffness = 1e5",
     "c.toml:27:24: contact[0].tangential_stiffness: found 100000 without friction; expected friction > 0 beside tangential_stiffness. Add friction, or remove tangential_stiffness."},
    {"time = [0.0, 1.0]",
     "time = [1.0, 0.0]",
     "c.toml:30:14: functions.ramp.time[1]: found 0 after 1; expected times in increasing order, the same time at most twice"},
    {"time = [0.0, 1.0]\nvalue = [0.0, 1.0]",
     "time = [0.0, 0.0, 0.0]\nvalue = [0.0, 1.0, 2.0]",
     "c.toml:30:19: functions.ramp.time[2]: found 0 after 0; expected times in increasing order, the same time at most twice"},
    {"time = [0.0, 1.0]",
     "time = [0.0, 1.0, 2.0]",
     "c.toml:31:9: functions.ramp.value: found 2 values; expected 3, one for each time"},
    {"time = [0.0, 1.0]",
     "time = []",
     "c.toml:30:8: functions.ramp.time: found a list of 0 values; expected a list of numbers in s"},
    {"value = 1.0\ntolerance",
     "value = 0.0\ntolerance",
     "c.toml:45:9: check[0].value: found 0 with a relative tolerance; expected absolute = true. A difference relative to 0 means nothing; give the tolerance in the unit of the quantity."},
    {"quantities = [\"displacement\"]",
     "quantities = [\"section_force\"]",
     "c.toml:40:15: probe[0].quantities: found \"section_force\" without group; expected a group of nodes on the section and the side whose cells are summed. Add for example side = [0, 0, 1]."},
    {"quantities = [\"displacement\"]",
     "quantities = [\"displacement\"]\nside = [0, 0, 1]",
     "c.toml:41:8: probe[0].side: found a side without section_force; expected side only where quantities have \"section_force\""},
    {"quantities = [\"displacement\"]",
     "quantities = []",
     "c.toml:40:14: probe[0].quantities: found an empty list; expected at least one quantity"},
    {"name = \"floor\"",
     "name = \"floor, wet\"",
     "c.toml:23:8: contact[0].name: found \"floor, wet\"; expected a name without commas, quotes and control characters"},
    {"material = \"steel\"",
     "material = \"steal\"",
     "c.toml:13:12: part[0].material: found the unknown name \"steal\"; expected the name of a [materials.NAME] (steel). Did you mean \"steel\"?"},
    {"material = \"steel\"",
     "material = \"copper\"",
     "c.toml:13:12: part[0].material: found the unknown name \"copper\"; expected the name of a [materials.NAME] (steel)"},
    {"function = \"ramp\"",
     "function = \"Ramp\"",
     "c.toml:16:35: support[0].velocity.function: found the unknown name \"Ramp\"; expected the name of a [functions.NAME] (ramp). Did you mean \"ramp\"?"},
    {"gravity = [0.0, 0.0, -9810.0]",
     "gravity = [0.0, 0.0, -9810.0]\nfunction = \"rmp\"",
     "c.toml:19:12: load[0].function: found the unknown name \"rmp\"; expected the name of a [functions.NAME] (ramp). Did you mean \"ramp\"?"},
    {"part = \"bar\"",
     "part = \"baar\"",
     "c.toml:20:8: initial[0].part: found the unknown name \"baar\"; expected the name of a [[part]] (bar). Did you mean \"bar\"?"},
    {"place = \"tip\"",
     "place = \"tpi\"",
     "c.toml:43:9: check[0].place: found the unknown name \"tpi\"; expected the name of a [[probe]] or [[contact]] (tip, floor)"},
    {"time = 5e-4",
     "time = 5e-3",
     "c.toml:44:8: check[0].time: found 0.005; expected a time of at most 0.001, the end of the run"},
    {"value = 1.0\ntolerance",
     "reference = \"exact\"\ntolerance",
     "c.toml:41:1: check[0].reference: found \"exact\" without a section [exact]; expected a section [exact] that says which solution. Add [exact], or give value instead of reference."},
    {"name = \"tip\"",
     "name = \"floor\"",
     "c.toml:38:8: probe[0].name: found the name \"floor\" a second time; expected a name of its own. The first is contact[0].name at line 23.\nc.toml:43:9: check[0].place: found the unknown name \"tip\"; expected the name of a [[probe]] or [[contact]] (floor, floor)\n2 errors"},
    {"[[support]]",
     "[[part]]\nname = \"bar\"\ncells = \"PAD\"\nmaterial = \"steel\"\n[[support]]",
     "c.toml:15:8: part[1].name: found the name \"bar\" a second time; expected a name of its own. The first is part[0].name at line 11."},
};
// clang-format on

std::string message_of(const std::string& text) {
  try {
    parse_case(text, "c.toml");
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CasefileMalformed, TheBaseCaseIsGood) {
  EXPECT_EQ(message_of(base), "no error");
}

TEST(CasefileMalformed, EveryMessage) {
  for (const Malformed& m : malformed) {
    const std::size_t at = base.find(m.from);
    ASSERT_NE(at, std::string::npos) << m.from;
    EXPECT_EQ(message_of(std::string(base).replace(at, std::string(m.from).size(), m.to)), m.message) << "for " << m.to;
  }
}

TEST(CasefileMalformed, ErrorsCarryTheirParts) {
  try {
    parse_case(std::string(base).replace(base.find("nu = 0.3"), 8, "nu = 0.5"), "c.toml");
    FAIL() << "nu = 0.5 was read";
  } catch (const CaseError& error) {
    EXPECT_EQ(error.where().line, 8);
    EXPECT_EQ(error.where().column, 6);
    EXPECT_EQ(error.key(), "materials.steel.nu");
    EXPECT_EQ(error.found(), "0.5");
    EXPECT_EQ(error.expected(), "a number > -1 and < 0.5");
  }
}

std::string message_of_file(const std::string& path) {
  try {
    read_case(path);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CasefileMalformed, KeysOutOfPlaceAreToldTheirSection) {
  const auto with = [](const std::string& from, const std::string& line) {
    return message_of(std::string(base).insert(base.find(from) + from.size(), line));
  };
  const auto ends_with = [](const std::string& text, const std::string& end) { return text.ends_with(end); };
  EXPECT_TRUE(ends_with(with("kind = \"newmark\"\n", "safety = 0.5\n"), " safety is a key of [time], [[stage]]."));
  EXPECT_TRUE(ends_with(with("step = 1e-6\n", "friction = 0.5\n"), " friction is a key of [[contact]], [exact]."));
}

TEST(CasefileMalformed, AMeshIsNoCase) {
  for (const char* mesh : {"sdnv100a.msh", "sdnv100a.med"}) {
    const std::string message = message_of_file(std::string(CAROM_SOURCE_DIR) + "/cases/sdnv100/meshes/" + mesh);
    EXPECT_NE(message.find("found a mesh file; expected a case file"), std::string::npos) << message;
  }
}

TEST(CasefileMalformed, FilesThatAreNoCases) {
  EXPECT_EQ(message_of_file("no/such.toml"), "no/such.toml: found no such file; expected a case file (.toml)");
  EXPECT_EQ(message_of_file("."), ".: found something that is not a file; expected a case file (.toml)");
  const std::string path = testing::TempDir() + "carom_binary.toml";
  std::ofstream(path, std::ios::binary) << std::string("\x00\x01\xff\xfe", 4);
  const std::string message = message_of_file(path);
  std::filesystem::remove(path);
  EXPECT_NE(message.find("carom_binary.toml:1:2: found a syntax error"), std::string::npos) << message;
}

TEST(CasefileMalformed, AnEmptyFileLacksAllThatACaseNeeds) {
  const std::string message = message_of("");
  EXPECT_TRUE(message.starts_with(
      "c.toml:1:1: mesh: found nothing; expected a section [mesh]. Add mesh: Where the mesh comes from: a file, "
      "structured blocks, or both.\nc.toml:1:1: materials: found nothing; expected sections [materials.NAME]."))
      << message;
  EXPECT_TRUE(message.ends_with("\n5 errors")) << message;
}

/// The mistakes of somebody's first case: each with its place, and none that follows from another.
TEST(CasefileMalformed, AllMistakesAreSaidAtOnce) {
  std::string text = base;
  const auto spoil = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  };
  spoil("law = \"linear_elastic\"", "law = \"linear_elastc\"");
  spoil("material = \"steel\"", "material = \"steal\"");
  spoil("kind = \"newmark\"", "kind = \"newmarc\"");
  spoil("name = \"tip\"", "nam = \"tip\"");
  try {
    parse_case(text, "c.toml");
    FAIL() << "read";
  } catch (const CaseError& error) {
    std::vector<std::string> keys;
    for (const CaseError& each : error.all()) keys.push_back(each.key());
    EXPECT_EQ(keys,
              (std::vector<std::string>{"materials.steel.law", "part[0].material", "scheme.kind", "probe[0].nam"}))
        << error.what();
    EXPECT_TRUE(std::string(error.what()).ends_with("\n4 errors")) << error.what();
  }
}

TEST(CasefileMalformed, EveryTruncationIsAnErrorOrACase) {
  for (std::size_t n = 0; n < base.size(); ++n) {
    const std::string message = message_of(base.substr(0, n));
    EXPECT_TRUE(message == "no error" || message.rfind("c.toml:", 0) == 0) << n << ": " << message;
  }
}

TEST(CasefileMalformed, DeepNestingIsAnError) {
  EXPECT_NE(message_of("title = " + std::string(100000, '[')).find("syntax error"), std::string::npos);
}

// Keys are read by recursion, and nobody's terminal has room for what somebody pasted.
TEST(CasefileMalformed, LongKeysAndTextsAreErrorsOfABearableLength) {
  std::string key = "a";
  for (int k = 0; k < 50000; ++k) key += ".a";
  EXPECT_EQ(message_of("title = \"t\"\n" + key + " = 1\n"),
            "c.toml:2:1: found a key of 50001 parts; expected at most 256. Keys of a case have two or three parts, as "
            "materials.steel.E.");
  EXPECT_LT(message_of("units = \"" + std::string(400000, 'm') + "\"\n").size(), 1000U);
}

TEST(Encoding, OtherThanUtf8IsNamed) {
  const auto message = [](const std::string& bytes) -> std::string {
    const std::string path = testing::TempDir() + "encoding.toml";
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      read_case(path);
    } catch (const CaseError& e) {
      return to_string(e.where()).substr(path.size()) + ": " + e.found() + ". " + e.suggestion();
    }
    return "";
  };
  const std::string remedy = ". Open it in the editor and save it as UTF-8.";
  EXPECT_EQ(message(std::string("\xff\xfet\0i\0", 6)), ": a text in UTF-16" + remedy);
  EXPECT_EQ(message(std::string("t\0i\0", 4)), ": a text in UTF-16" + remedy);
  EXPECT_EQ(message("units = \"SI\"\ntitle = \"Sto\xdf\"\n"),
            ":2:13: the byte 0xdf, which is not UTF-8 (is this Latin-1?)" + remedy);
  EXPECT_EQ(message("title = \"Stoß, µ, €\"\n").find("UTF"), std::string::npos);
}

}  // namespace
}  // namespace carom::casefile_malformed_test
