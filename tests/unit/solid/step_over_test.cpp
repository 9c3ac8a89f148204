// Steps that are over (PointStep::is_over): bodies of every element with every law and with viscosity, and glue.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "law_samples.hpp"
#include "solid/cell_values.hpp"
#include "solid/point_history.hpp"
#include "solid_bodies.hpp"

namespace carom::test::solid_step_over_test {
namespace {

std::string name_of_element(const Element& element) {
  std::string name = name_of(Body{element, unit_material});
  return name.substr(0, name.size() - std::string("LinearElastic").size());
}

class StepOver : public testing::TestWithParam<std::tuple<Element, Material>> {
 protected:
  static Model model(const Viscosity& viscosity) {
    const auto& [element, material] = GetParam();
    Model model = body(distorted_mesh(element.type), element, material);
    model.parts[0].viscosity = viscosity;
    return model;
  }
};

// Two steps that flow, evaluated again from the histories at their ends. Forces are some 100 at most, sums of some
// hundred products.
TEST_P(StepOver, IsWhatItWas) {
  const auto& [element, material] = GetParam();
  constexpr double round_off = 1e-11;
  const bool has_modes = element.formulation == Formulation::one_point;
  for (const Viscosity& viscosity : {Viscosity{}, {0.1, 1.2, has_modes ? 0.1 : 0.0}}) {
    const Solid solid(model(viscosity));
    std::vector<double> history = initial_history(solid), end(history.size()), again(history.size());
    std::vector<double> f(solid.dof_count()), g(solid.dof_count());
    for (const unsigned seed : {1U, 2U}) {
      SCOPED_TRACE(testing::Message() << "step " << seed << ", viscosity " << viscosity.linear);
      std::vector<double> u = random_vector(solid.dof_count(), seed);
      for (double& x : u) x *= 0.5 * largest_move(element.type);
      const PointStep step{.dt = 0.1, .history = history}, over{.dt = 0.1, .history = end, .is_over = true};
      const SolidEnergies energies = solid.evaluate(u, step, f, end), later = solid.evaluate(u, over, g, again);
      const double scale = std::max(1.0, largest(f));
      EXPECT_EQ(end == history, history.empty());
      EXPECT_LT(largest_difference(f, g), round_off * scale);
      EXPECT_LT(largest_difference(end, again), round_off);
      for (double SolidEnergies::*const term : SolidEnergies::terms)
        EXPECT_NEAR(energies.*term, later.*term, round_off * scale);
      const auto stress = cell_stress(solid, u, step), stress_later = cell_stress(solid, u, over);
      for (std::size_t k = 0; k < stress.size(); ++k)
        for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(stress[k][c], stress_later[k][c], round_off * scale);
      if (!viscosity.is_any()) {  // which remembers the displacement
        for (double& x : u) x *= 1.2;
        solid.evaluate(u, over, g, again);
        EXPECT_LT(largest_difference(end, again), round_off) << "at any displacement";
      }
      history = end;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(, StepOver, testing::Combine(testing::ValuesIn(elements()), testing::ValuesIn(all_samples())),
                         [](const auto& of) {
                           return name_of_element(std::get<0>(of.param)) + "_" + name_of(std::get<1>(of.param));
                         });

}  // namespace
}  // namespace carom::test::solid_step_over_test
