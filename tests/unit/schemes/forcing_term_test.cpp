// How exactly inexact Newton steps are solved.
#include "schemes/forcing_term.hpp"

#include <gtest/gtest.h>

namespace carom::schemes_forcing_term_test {
namespace {

// Eisenstat and Walker, SIAM J. Sci. Comput. 17, 1996, choice 1: eta = | |r_k| - |r_k-1 + J s| | / |r_k-1|.
TEST(ForcingTerm, IsTheShareInWhichTheLastModelErred) {
  ForcingTerm forcing(false);
  EXPECT_EQ(forcing.next(10.0, 1e-12), 1e-3 * 10.0);  // nothing is known: at most a thousandth
  forcing.solved(0.01);
  EXPECT_EQ(forcing.next(6.0, 1e-12), 1e-3 * 6.0);  // the model was wrong by 0.6, cut to a thousandth
  forcing.solved(0.006);
  EXPECT_DOUBLE_EQ(forcing.next(0.0066, 1e-12), (0.0066 - 0.006) / 6.0 * 0.0066);
}

TEST(ForcingTerm, GoesToTheEndWhereTheModelIsExact) {
  ForcingTerm known(true);
  EXPECT_EQ(known.next(10.0, 1e-12), 1e-12);
  ForcingTerm found(false);
  found.next(10.0, 1e-12);
  found.solved(0.01);
  EXPECT_EQ(found.next(0.01, 1e-12), 1e-12);  // the residual is what the model foretold
}

// Less than thirty times above what is wanted, another solve would cost more than it saves.
TEST(ForcingTerm, DoesNotStopShortlyBeforeTheEnd) {
  EXPECT_EQ(ForcingTerm(false).next(1.0, 1e-4), 1e-4);
  EXPECT_EQ(ForcingTerm(false).next(1.0, 1e-5), 1e-3);
}

}  // namespace
}  // namespace carom::schemes_forcing_term_test
