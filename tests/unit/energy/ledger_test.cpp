// The sums of the energy ledger, with numbers that are exact in binary.
#include "energy/ledger.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace carom::energy_ledger_test {
namespace {

EnergyTerms initial_energy() {
  EnergyTerms terms;
  terms.kinetic = 8.0;
  terms.strain = 2.0;
  return terms;
}

/// Four units of work done by a load, of which the kinetic energy gets 1, the strain 0.5, friction 0.75, dampers 0.25,
/// the scheme 1 and the trapezoidal rule `misplaced`.
LedgerIncrement step(double misplaced) {
  LedgerIncrement increment;
  increment.energy.kinetic = 1.0;
  increment.energy.strain = 0.5;
  increment.energy.friction = 0.75;
  increment.energy.damping = 0.25;
  increment.energy.algorithmic = 1.0;
  increment.energy.quadrature = misplaced;
  increment.energy.external_work = 4.0;
  increment.impulse.linear = {1.0, 0.0, -2.0};
  increment.impulse.angular = {0.0, 0.5, 0.0};
  return increment;
}

Momentum momentum(double x, double z) {
  Momentum p;
  p.linear = {x, 0.0, z};
  return p;
}

TEST(EnergyLedger, IsClosedWhenWorkIsStoredOrDissipated) {
  EnergyLedger ledger(initial_energy(), momentum(4.0, 0.0), 1.0);
  EXPECT_EQ(ledger.imbalance(), 0.0);
  ledger.add(step(0.5), momentum(5.0, -2.0));
  EXPECT_EQ(ledger.imbalance(), 0.0);
  ledger.add(step(0.25), momentum(6.0, -4.0));
  EXPECT_EQ(ledger.imbalance(), -0.25);  // a quarter of the second step's work is nowhere
  EXPECT_EQ(ledger.now().kinetic, 10.0);
  EXPECT_EQ(ledger.now().strain, 3.0);
  EXPECT_EQ(ledger.now().friction, 1.5);
  EXPECT_EQ(ledger.now().mechanical(), 13.0);
  EXPECT_EQ(ledger.growth(), 3.0 - 8.0);  // mechanical energy gained minus work supplied
}

TEST(EnergyLedger, ComparesMomentumWithImpulses) {
  EnergyLedger ledger(initial_energy(), momentum(4.0, 0.0), 1.0);
  ledger.add(step(0.5), momentum(5.0, -1.5));
  EXPECT_EQ(ledger.momentum_error().linear, (Vec3{0.0, 0.0, 0.5}));
  EXPECT_EQ(ledger.momentum_error().angular, (Vec3{0.0, -0.5, 0.0}));
}

TEST(EnergyLedger, ScaleIsTheLargerOfInitialAndLargestSuppliedEnergy) {
  EnergyLedger ledger(initial_energy(), {}, 1.0);
  EXPECT_EQ(ledger.scale(), 10.0);
  for (int i = 0; i < 3; ++i) ledger.add(step(0.5), {});
  EXPECT_EQ(ledger.scale(), 12.0);
  LedgerIncrement back;
  back.energy.support_work = -11.0;
  ledger.add(back, {});
  EXPECT_EQ(ledger.scale(), 12.0);  // the peak counts
}

// DISS_SCH closes the balance in Code_Aster's terms (U4.84, ENERGIE).
TEST(AsterTerms, SchemeDissipationIsWhatRemains) {
  AsterTerms terms;
  terms.ENER_CIN = 1.0;
  terms.ENER_TOT = 2.0;
  terms.TRAV_EXT = 16.0;
  terms.TRAV_AMOR = 0.5;
  terms.TRAV_LIAI = 0.25;
  EXPECT_EQ(terms.DISS_SCH(), 12.25);
  terms += terms;
  EXPECT_EQ(terms.DISS_SCH(), 24.5);
}

// Each term is given 1 in turn: stored, dissipated and scheme's terms leave a balance of 1, supplied ones of -1, memos
// none.
TEST(EnergyTerms, EnterTheBalanceByTheirKind) {
  for (const EnergyTerm& term : energy_terms) {
    EnergyTerms terms;
    terms.*term.value = 1.0;
    const bool is_memo = term.kind == TermKind::memo;
    EXPECT_EQ(terms.imbalance(), is_memo ? 0.0 : term.kind == TermKind::supplied ? -1.0 : 1.0) << term.name;
    EXPECT_EQ(terms.mechanical(), term.kind == TermKind::stored ? 1.0 : 0.0) << term.name;
    EXPECT_EQ(change_of_state({}, terms).mechanical(), terms.mechanical()) << term.name;
    terms += terms;
    EXPECT_EQ(terms.*term.value, 2.0) << term.name;
  }
}

TEST(EnergyTerms, AreTheManuals) {
  std::ostringstream manual;
  manual << std::ifstream(CAROM_SOURCE_DIR "/docs/architecture.md").rdbuf();
  const char* kinds[] = {"stored", "spent", "dissipated", "supplied", "scheme", "memo"};
  for (const EnergyTerm& term : energy_terms) {
    const std::string row = "| `" + std::string(term.name) + "` | " + kinds[static_cast<int>(term.kind)] + " | " +
                            std::string(term.definition) + " |\n";
    EXPECT_NE(manual.str().find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace carom::energy_ledger_test
