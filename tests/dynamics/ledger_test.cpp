#include "dynamics/ledger.hpp"

#include <gtest/gtest.h>

namespace nereid::dynamics {
namespace {

Account block() {
  Account a;
  a.work = -10;
  a.stored[Stored::elastic] = 4, a.stored[Stored::hourglass] = 1;
  a.dissipated[Dissipated::plastic] = 3, a.dissipated[Dissipated::viscous] = 1.5;
  return a;
}

TEST(Ledger, CreatedIsWhatASourceNeitherStoredNorDissipated) {
  Account a = block();
  EXPECT_EQ(stored(a), 5);
  EXPECT_EQ(dissipated(a), 4.5);
  EXPECT_EQ(created(a), -0.5);
  a.work = -9;  // took less from the nodes than it holds
  EXPECT_EQ(created(a), 0.5);
  EXPECT_EQ(created(Account{}), 0);
}

TEST(Ledger, WorkOfAllSourcesAndTheIntegrationExplainTheKineticEnergy) {
  Ledger ledger;
  ledger.initial_kinetic = 100;
  ledger.accounts = {block(), block()};
  ledger.integration = 2;
  ledger.kinetic = 82;
  EXPECT_EQ(energy_residual(ledger), 0);
  ledger.kinetic = 83;
  EXPECT_EQ(energy_residual(ledger), 1);
}

TEST(Ledger, CreatedEnergyIsHeldAgainstTheLargestThatWasThere) {
  Ledger ledger;
  EXPECT_EQ(energy_scale(ledger), 0);
  ledger.accounts = {block()};
  Account force, gravity, brake;
  force.work = 7, force.stored[Stored::external_work] = -7;
  gravity.work = 2, gravity.stored[Stored::potential] = -2;
  brake.work = -4, brake.stored[Stored::external_work] = 4;
  ledger.accounts.insert(ledger.accounts.end(), {force, gravity, brake});
  EXPECT_EQ(work_from_loads(ledger), 9);
  ledger.external_work = 9;
  EXPECT_EQ(energy_scale(ledger), 9);
  ledger.accounts[1].work = 1;  // it took some back: the scale does not fall
  EXPECT_EQ(energy_scale(ledger), 9);
  ledger.initial_kinetic = 10;
  EXPECT_EQ(energy_scale(ledger), 10);
  ledger.accounts[0].at_start[Stored::elastic] = 12;
  EXPECT_EQ(energy_scale(ledger), 12);
}

TEST(Ledger, ImpulsesExplainTheMomenta) {
  Ledger ledger;
  ledger.initial_momentum = {1, 2, 3};
  ledger.initial_angular_momentum = {4, 5, 6};
  ledger.accounts.resize(2);
  ledger.accounts[0].impulse = {0, 0, -1};
  ledger.accounts[1].impulse = {1, 0, 0};
  ledger.accounts[0].angular_impulse = {0, 2, 0};
  ledger.momentum = {2, 2, 2};
  ledger.angular_momentum = {4, 7, 6};
  EXPECT_EQ(momentum_residual(ledger), Vec3(0, 0, 0));
  EXPECT_EQ(angular_momentum_residual(ledger), Vec3(0, 0, 0));
  ledger.momentum.y() = 3;
  ledger.angular_momentum.x() = 3;
  EXPECT_EQ(momentum_residual(ledger), Vec3(0, 1, 0));
  EXPECT_EQ(angular_momentum_residual(ledger), Vec3(-1, 0, 0));
}

}  // namespace
}  // namespace nereid::dynamics
