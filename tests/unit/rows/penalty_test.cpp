// Penalty enforcement: forces, energies and tangents of single rows against closed forms and finite differences.
#include "rows/penalty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/vec3.hpp"
#include "solid_fixture.hpp"

namespace carom::contact_penalty_test {
namespace {

using namespace test;

constexpr double round_off = 1e-14;  // a few operations on numbers near 1

using Rows = std::shared_ptr<const ConstraintRows>;

/// A row of one node against a plane z = -gap.
Rows single_node(const RowLaw& law, double gap = 0.0) {
  ConstraintRows rows;
  rows.add_row(gap, {0, 0, 1}, {}, 1.0, law, 0);
  rows.add_node(0, 1.0);
  return std::make_shared<const ConstraintRows>(std::move(rows));
}

/// One node that has moved to u from u_begin.
ContactResponse respond(const Rows& rows, const Vec3& u_begin, const Vec3& u, const RowHistory& history = {},
                        const Vec3& v = {}) {
  ContactResponse response;
  penalty_response(rows, u_begin, u, v, std::vector<RowHistory>{history}, response);
  return response;
}

Vec3 force_on_node(const ContactResponse& response) {
  Vec3 f{};
  response.add_force(f);
  return f;
}

// A body that touches at the origin has gaps of nothing but rounding, of which its own displacement, 1e-25, says
// nothing.
TEST(ConstraintRows, AreClosedByRoundingOfTheLengthsOfTheBodies) {
  ConstraintRows rows;
  rows.add_row(0.0, {0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, 1.0, {}, 0);
  rows.add_node(0, 1.0);
  std::vector<double> u{0.0, 0.0, 1e-25};
  EXPECT_FALSE(rows.is_closed(0, u));
  EXPECT_TRUE(rows.is_closed(0, u, 1.0));
  u[2] = 1e-12;  // 4500 units of round-off of 1
  EXPECT_FALSE(rows.is_closed(0, u, 1.0));
}

TEST(PenaltyForce, IsProportionalToThePenetrationAndNeverTensile) {
  const Rows penalty = single_node({.eps_N = 4.0}, 0.5);
  const auto closed = respond(penalty, {}, {0, 0, -0.75});
  EXPECT_NEAR(force_on_node(closed)[2], 4.0 * 0.25, round_off);
  EXPECT_NEAR(closed.stored, 0.5 * 4.0 * 0.25 * 0.25, round_off);
  for (const double z : {-0.5, -0.4, 3.0}) {  // just closed, open, far away
    const auto open = respond(penalty, {}, {0.1, 0, z});
    EXPECT_EQ(norm(force_on_node(open)), 0.0);
    EXPECT_EQ(open.stored, 0.0);
  }
}

// Straight from (0, 0) over (0.1, 1) and (0.3, 5), and on with slope 20; at twice the measure. By hand: at 0.2 the
// pressure is 3 and the area below it 0.05 + 0.2; at 0.4 they are 7, and 0.05 + 0.6 + 0.6.
TEST(PenaltyForce, FollowsATableOfPressures) {
  const PressureTable table({0.1, 0.3}, {1.0, 5.0});
  RowLaw law{.eps_N = 2.0 * table.largest_slope()};
  law.own = {&table, 2.0};
  EXPECT_NEAR(law.eps_N, 40.0, 40.0 * round_off);
  const Rows penalty = single_node(law);
  struct Place {
    double depth, pressure, slope, energy;
  };
  for (const Place& at : {Place{0.05, 0.5, 10.0, 0.0125}, Place{0.2, 3.0, 20.0, 0.25}, Place{0.4, 7.0, 20.0, 1.25}}) {
    const Vec3 u{0, 0, -at.depth};
    const auto response = respond(penalty, {}, u);
    EXPECT_NEAR(force_on_node(response)[2], 2.0 * at.pressure, 10 * round_off);
    EXPECT_NEAR(response.stored, 2.0 * at.energy, 10 * round_off);
    const RowTangent D = penalty_tangent(*penalty, 0, Vec3{}, u, Vec3{}, std::vector<RowHistory>(1), 0.0);
    EXPECT_NEAR(D[0], 2.0 * at.slope, 100 * round_off);
    EXPECT_EQ(law.steepest_slope(at.depth), law.eps_N);
  }
  EXPECT_EQ(norm(force_on_node(respond(penalty, {}, {0, 0, 0.1}))), 0.0);
}

// eps_N = 4, d_0 = 0.1: at 0.1 still 0.4, at 0.3 it is 4 (0.3 + 0.2^3 / 0.1^2) = 4.4. Force and slope are derivatives
// of the stored energy (central differences of polynomials of degree 4: h^2 / 6 times their third derivative, 1e-7
// here).
TEST(PenaltyForce, HardensBelowItsLinearDepth) {
  RowLaw law{.eps_N = 4.0};
  law.linear_depth = 0.1;
  const Rows penalty = single_node(law);
  const auto at = [&](double depth) { return respond(penalty, {}, {0, 0, -depth}); };
  EXPECT_NEAR(at(0.1).force[0][0], 0.4, round_off);
  EXPECT_NEAR(at(0.3).force[0][0], 4.4, round_off);
  constexpr double h = 1e-5;
  const std::vector<RowHistory> history(1);
  for (const double depth : {0.05, 0.11, 0.25}) {
    EXPECT_NEAR((at(depth + h).stored - at(depth - h).stored) / (2.0 * h), at(depth).force[0][0], 1e-6);
    const Vec3 begin{}, u{0, 0, -depth};
    EXPECT_NEAR(penalty_tangent(*penalty, 0, begin, u, begin, history, 0.0)[0],
                (at(depth + h).force[0][0] - at(depth - h).force[0][0]) / (2.0 * h), 1e-6);
  }
}

TEST(PenaltyForce, OfADamperActsOnlyInStepsThatBeginClosedAndNeverPulls) {
  const Rows stop = single_node({.eps_N = 4.0, .damping = 2.0});
  const Vec3 closing{0, 0, -3.0}, opening{0, 0, 3.0}, at{0, 0, -0.25};
  EXPECT_NEAR(respond(stop, {0, 0, -0.1}, at, {}, closing).force[0][0], 4.0 * 0.25 + 2.0 * 3.0, round_off);
  EXPECT_NEAR(respond(stop, {0, 0, 0.1}, at, {}, closing).force[0][0], 4.0 * 0.25, round_off);
  EXPECT_EQ(respond(stop, {0, 0, -0.1}, at, {}, opening).force[0][0], 0.0);  // 1 - 6 < 0
  const auto pressed = respond(stop, {0, 0, -0.1}, at, {}, closing);
  EXPECT_NEAR(pressed.damper[0], 2.0 * 3.0, round_off);
  EXPECT_NEAR(pressed.stored, 0.5 * 4.0 * 0.25 * 0.25, round_off);
}

TEST(PenaltyForce, OfATwoSidedDamperPullsWhileTheRowIsClosed) {
  const Rows stop = single_node({.eps_N = 4.0, .damping = 2.0, .damper_acts = DamperActs::two_sided});
  const Vec3 closing{0, 0, -3.0}, opening{0, 0, 3.0}, at{0, 0, -0.25};
  EXPECT_NEAR(respond(stop, {0, 0, -0.1}, at, {}, closing).force[0][0], 4.0 * 0.25 + 2.0 * 3.0, round_off);
  const auto pulled = respond(stop, {0, 0, -0.1}, at, {}, opening);
  EXPECT_NEAR(pulled.force[0][0], 4.0 * 0.25 - 2.0 * 3.0, round_off);
  EXPECT_NEAR(pulled.damper[0], -2.0 * 3.0, round_off);
  // In the step that opens the row the spring is slack and the damper still holds; in the next nothing does.
  EXPECT_NEAR(respond(stop, {0, 0, -0.1}, {0, 0, 0.2}, {}, opening).force[0][0], -2.0 * 3.0, round_off);
  EXPECT_EQ(respond(stop, {0, 0, 0.1}, {0, 0, 0.2}, {}, opening).force[0][0], 0.0);
}

// eps_N = 10, penetration 0.2, mu = 0.3: p = 2, limit 0.6; eps_T = 5 sticks up to a slip of 0.12.
struct Friction : testing::Test {
  Rows penalty = single_node({.eps_N = 10.0, .eps_T = 5.0, .mu = 0.3});
  const double pressure = 2.0, limit = 0.6, eps_T = 5.0, yield = 0.12;
  Vec3 direction{0.6, 0.8, 0.0};
  Vec3 at(double slip) const { return {slip * direction[0], slip * direction[1], -0.2}; }
};

TEST_F(Friction, SticksThenSlides) {
  const Vec3 begin = at(0.0);
  for (const double slip : {0.01, 0.06, 0.119}) {
    const auto stick = respond(penalty, begin, at(slip));
    EXPECT_EQ(stick.status[0], RowStatus::stick);
    const Vec3 f = force_on_node(stick);
    EXPECT_NEAR(f[0], -eps_T * slip * direction[0], round_off);
    EXPECT_NEAR(f[1], -eps_T * slip * direction[1], round_off);
    EXPECT_EQ(stick.slip_work, 0.0);
  }
  for (const double slip : {0.121, 0.5, 20.0}) {
    const auto slide = respond(penalty, begin, at(slip));
    EXPECT_EQ(slide.status[0], RowStatus::slip);
    const Vec3 f = force_on_node(slide);
    EXPECT_NEAR(f[0], -limit * direction[0], round_off);
    EXPECT_NEAR(f[1], -limit * direction[1], round_off);
    EXPECT_NEAR(f[2], pressure, round_off);
    EXPECT_NEAR(slide.slip_work, limit * (slip - yield), 20 * round_off);
  }
}

// From a gap of 0.3 to a penetration of 0.2 on a straight path: 0.2 / 0.5 of the sliding is in contact.
TEST_F(Friction, FirstTouchCountsTheSlidingInContact) {
  Vec3 begin = at(0.0);
  begin[2] = 0.3;
  const auto stick = respond(penalty, begin, at(0.1));
  EXPECT_EQ(stick.status[0], RowStatus::stick);
  EXPECT_NEAR(force_on_node(stick)[0], -eps_T * 0.4 * 0.1 * direction[0], round_off);
  const auto slide = respond(penalty, begin, at(1.0));
  EXPECT_EQ(slide.status[0], RowStatus::slip);
  EXPECT_NEAR(slide.slip_work, limit * (0.4 - yield), 10 * round_off);
}

// Without inertia a body stops at the touch and slides on: nothing says which part of the sliding came before.
TEST_F(Friction, FirstTouchCountsAllSlidingWithoutInertia) {
  Vec3 begin = at(0.0);
  begin[2] = 0.3;
  ContactResponse slide;
  const std::vector<RowHistory> history(1);
  penalty_response(penalty, begin, at(1.0), Vec3{}, history, slide, CountedSlip::whole_step);
  EXPECT_EQ(slide.status[0], RowStatus::slip);
  EXPECT_NEAR(slide.slip_work, limit * (1.0 - yield), 10 * round_off);
}

// Path in many steps: the work of the tangential force is what is stored and what has slipped away. The trapezoidal
// rule is exact while sticking and while sliding; the one step across the corner misses at most the corner's triangle,
// 1/2 eps_T (ds/2)^2 / 2 at ds = 0.001 (here the corner falls on a step: round-off only).
TEST_F(Friction, WorkIsStoredOrDissipated) {
  RowHistory history;
  double work = 0.0, dissipated = 0.0, before = 0.0;
  const int steps = 500;
  ContactResponse response;
  for (int i = 1; i <= steps; ++i) {
    response = respond(penalty, at(0.001 * (i - 1)), at(0.001 * i), history);
    history = response.history[0];
    const double tangential = std::hypot(response.force[0][1], response.force[0][2]);
    work += 0.5 * (before + tangential) * 0.001;
    before = tangential;
    dissipated += response.slip_work;
  }
  const double tangential_stored = response.stored - 0.5 * 10.0 * 0.2 * 0.2;
  EXPECT_NEAR(tangential_stored, 0.5 * eps_T * yield * yield, round_off);
  EXPECT_NEAR(dissipated, limit * (0.5 - yield), 1e-12);  // 500 sums
  EXPECT_NEAR(work, tangential_stored + dissipated, 1e-12);
}

TEST_F(Friction, ReversalSticksOverTwiceTheYieldSlip) {
  RowHistory history = respond(penalty, at(0.0), at(0.5)).history[0];
  const auto back = respond(penalty, at(0.5), at(0.5 - yield), history);  // half way: no force
  EXPECT_EQ(back.status[0], RowStatus::stick);
  EXPECT_NEAR(norm({force_on_node(back)[0], force_on_node(back)[1], 0}), 0.0, 10 * round_off);
  const auto almost = respond(penalty, at(0.5), at(0.5 - 1.99 * yield), history);
  EXPECT_EQ(almost.status[0], RowStatus::stick);
  const auto sliding = respond(penalty, at(0.5), at(0.5 - 2.5 * yield), history);
  EXPECT_EQ(sliding.status[0], RowStatus::slip);
  EXPECT_NEAR(force_on_node(sliding)[0], limit * direction[0], 10 * round_off);
  EXPECT_NEAR(sliding.slip_work, limit * 0.5 * yield, 10 * round_off);
}

TEST_F(Friction, OpenRowsForgetTheirSlip) {
  const RowHistory history = respond(penalty, at(0.0), at(0.1)).history[0];
  EXPECT_NE(history, RowHistory{});
  const auto open = respond(penalty, at(0.1), {0.1, 0.2, 0.05}, history);
  EXPECT_EQ(open.status[0], RowStatus::open);
  EXPECT_EQ(open.history[0], RowHistory{});
  EXPECT_EQ(open.stored, 0.0);
}

// -d(force)/dw by central differences with step 1e-6 at numbers near 1: truncation 1e-12, cancellation 1e-16 / 1e-6.
constexpr double difference_step = 1e-6, difference_tolerance = 1e-8;

void check_tangent(const Rows& penalty, const Vec3& u_begin, const Vec3& u, const Vec3& v, const RowHistory& history,
                   double dv_dx) {
  const std::vector<RowHistory> histories{history};
  const RowTangent D = penalty_tangent(*penalty, 0, u_begin, u, v, histories, dv_dx);
  const ConstraintRows& rows = *penalty;
  const std::array<Vec3, 3> frame{rows.normal[0], rows.tangent_1[0], rows.tangent_2[0]};
  for (std::size_t j = 0; j < 3; ++j) {
    std::array<Vec3, 2> force;
    for (const int side : {0, 1}) {
      const double h = side == 0 ? -difference_step : difference_step;
      force[static_cast<std::size_t>(side)] =
          respond(penalty, u_begin, add(u, scaled(frame[j], h)), history, add(v, scaled(frame[j], dv_dx * h))).force[0];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(D[3 * i + j], -(force[1][i] - force[0][i]) / (2 * difference_step), difference_tolerance)
          << "row " << i << ", column " << j;
    }
  }
}

TEST(PenaltyTangent, IsTheDerivativeOfTheForce) {
  const Rows frictional = single_node({.eps_N = 10.0, .eps_T = 5.0, .mu = 0.3});
  const Rows damped = single_node({.eps_N = 10.0, .damping = 2.0});
  const Rows held = single_node({.eps_N = 10.0, .damping = 2.0, .damper_acts = DamperActs::two_sided});
  int sticking = 0, sliding = 0, open = 0, pressed = 0, lifted = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const std::vector<double> x = random_vector(12, seed);
    const Vec3 begin{0.1 * x[0], 0.1 * x[1], 0.1 * x[2]}, u{0.2 * x[3], 0.2 * x[4], 0.2 * x[5]}, v{x[6], x[7], x[8]};
    const RowHistory history{{0.02 * x[9], 0.02 * x[10], 0.0}, {}};
    SCOPED_TRACE(seed);
    check_tangent(frictional, begin, u, v, history, 3.0);
    check_tangent(damped, begin, u, v, {}, 3.0);
    check_tangent(held, begin, u, v, {}, 3.0);
    const RowStatus status = respond(frictional, begin, u, history).status[0];
    (status == RowStatus::open ? open : status == RowStatus::stick ? sticking : sliding)++;
    if (begin[2] < 0.0 && u[2] < 0.0) (respond(damped, begin, u, {}, v).force[0][0] > 0.0 ? pressed : lifted)++;
  }
  // The draw covers every branch.
  EXPECT_GT(std::min({sticking, sliding, open, pressed, lifted}), 0)
      << sticking << " " << sliding << " " << open << " " << pressed << " " << lifted;
}

// Sliding couples the normal to the tangential direction: |t| = mu p, so that d|t|/dw_N = -mu eps_N, and nothing back.
TEST_F(Friction, SlidingTangentIsNotSymmetric) {
  const Vec3 begin = at(0.0), u = at(0.5);
  const std::vector<RowHistory> history(1);
  const RowTangent D = penalty_tangent(*penalty, 0, begin, u, Vec3{}, history, 0.0);
  EXPECT_NEAR(std::hypot(D[3], D[6]), 0.3 * 10.0, 10 * round_off);
  EXPECT_EQ(D[1], 0.0);
  EXPECT_EQ(D[2], 0.0);
}

TEST(PenaltyStored, ForceIsMinusItsGradientWithoutSlip) {
  ConstraintRows rows;
  // Closed from the beginning: a step that closes it counts only a part of the sliding. mu is so large that nothing
  // slides.
  rows.add_row(-0.05, {0.6, 0.0, 0.8}, {}, 1.0, {.eps_N = 3.0, .eps_T = 2.0, .mu = 1e3}, 0);
  rows.add_node(0, 0.7);
  rows.add_node(1, 0.3);
  rows.add_node(2, -1.0);
  rows.add_row(-0.3, {0.0, 1.0, 0.0}, {}, 1.0, {.eps_N = 4.0}, 0);
  rows.add_node(1, 1.0);
  const Rows penalty = std::make_shared<const ConstraintRows>(std::move(rows));
  const std::vector<RowHistory> history(2);
  const std::vector<double> begin(9, 0.0), v(9, 0.0);
  int closed = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<double> u = random_vector(9, seed), force(9, 0.0);
    ContactResponse response;
    penalty_response(penalty, begin, u, v, history, response);
    response.add_force(force);
    if (response.status[0] == RowStatus::stick) ++closed;
    for (std::size_t i = 0; i < u.size(); ++i) {
      std::array<double, 2> stored{};
      for (const std::size_t side : {0U, 1U}) {
        std::vector<double> x = u;
        x[i] += side == 0 ? -difference_step : difference_step;
        penalty_response(penalty, begin, x, v, history, response);
        stored[side] = response.stored;
      }
      EXPECT_NEAR(force[i], -(stored[1] - stored[0]) / (2 * difference_step), difference_tolerance);
    }
  }
  EXPECT_GT(closed, 3);
}

TEST(PenaltyClosedStiffness, IsTheTangentOfClosedSticking) {
  const Rows penalty = single_node({.eps_N = 10.0, .eps_T = 5.0, .mu = 0.3});
  const Vec3 x{0.5, -0.25, 2.0};
  Vec3 y{1.0, 1.0, 1.0};
  add_closed_stiffness(*penalty, x, y);
  EXPECT_NEAR(norm(subtract(y, {1.0 + 2.5, 1.0 - 1.25, 1.0 + 20.0})), 0.0, 10 * round_off);
}

}  // namespace
}  // namespace carom::contact_penalty_test
