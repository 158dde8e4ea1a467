#include "dynamics/ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nereid::dynamics::ledger_test {
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

TEST(Ledger, WhatAStoreGaveAndNeverHeldIsCreated) {
  Account a;
  a.work = -4, a.hold(Stored::elastic, 4);
  EXPECT_EQ(created(a), 0);
  a.work = 2, a.hold(Stored::elastic, -2);  // a law in rates, on a path that does not close
  EXPECT_EQ(stored(a), -2);
  EXPECT_EQ(created(a), 2);
  a.at_start[Stored::elastic] = 3;
  a.work = 2, a.hold(Stored::elastic, 1);  // it began with 3
  EXPECT_EQ(created(a), 0);
  a.work = 4, a.hold(Stored::elastic, -1);
  EXPECT_EQ(created(a), 1);
  Account bent;
  bent.work = 2, bent.hold(Stored::hourglass, -2);
  EXPECT_EQ(created(bent), 2) << "what acts against hourglassing is a law in rates, too";
  a.hold(Stored::elastic, NAN);
  EXPECT_TRUE(std::isnan(created(a))) << "a run says so";
  Account load;
  load.work = 5, load.hold(Stored::external_work, -5);
  EXPECT_EQ(created(load), 0) << "from outside";
}

TEST(Ledger, RemembersTheMostThatASourceHasCreatedOfTheScene) {
  Ledger ledger;
  ledger.accounts.resize(2), ledger.flows.resize(2);
  update_created(ledger);  // no scale yet
  EXPECT_EQ(ledger.flows[0].worst_of_scene, 0);
  ledger.initial_available = ledger.initial_kinetic = 100;
  const auto look = [&](double first, double second) {
    ledger.accounts[0].work = first, ledger.accounts[1].work = second;
    update_created(ledger);
  };
  look(3, -4), look(0, 1), look(-2, -3);
  EXPECT_EQ(ledger.flows[0].worst_of_scene, 0.03);
  EXPECT_EQ(ledger.flows[1].worst_of_scene, -0.04);
}

TEST(Ledger, WorkOfAllSourcesAndTheIntegrationExplainTheKineticEnergy) {
  Ledger ledger;
  ledger.initial_available = ledger.initial_kinetic = 100;
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
  ledger.initial_available = ledger.initial_kinetic = 10;
  EXPECT_EQ(energy_scale(ledger), 10);
  ledger.accounts[0].at_start[Stored::elastic] = 12;
  EXPECT_EQ(energy_scale(ledger), 12);
}

TEST(Ledger, ASceneIsJudgedBetweenRowsAgainstWhatLoadsHaveDoneByNow) {
  Ledger ledger;
  Account force;
  force.work = 7, force.stored[Stored::external_work] = -7;
  ledger.accounts = {force}, ledger.flows.resize(1);
  update_flows(ledger);
  EXPECT_EQ(energy_scale(ledger), 0);  // at rest before its first row it is not judged
  ledger.external_work = 1e-9;
  update_flows(ledger);
  EXPECT_EQ(energy_scale(ledger), 7);
}

TEST(EnergyFloor, IsTheWorkOfTheLargestForceOverAThousandthOfTheSize) {
  Ledger ledger;
  ledger.size = 2, ledger.largest_force = 3;
  EXPECT_DOUBLE_EQ(energy_floor(ledger), 0.006);
  EXPECT_EQ(energy_of_scene(ledger), 0);
  EXPECT_EQ(energy_scale(ledger), energy_floor(ledger));
  ledger.external_work = 0.01;
  EXPECT_EQ(energy_scale(ledger), 0.01);
  EXPECT_EQ(energy_of_scene(ledger), 0.01);
  ledger.round_off = 0.02;
  EXPECT_EQ(energy_scale(ledger), 0.02);
}

/// A ledger of a scene of 1 J with two sources of which the second does `works`, step by step, all of it stored but for `created`.
Ledger after(std::initializer_list<double> works, double created) {
  Ledger ledger;
  ledger.initial_available = ledger.initial_kinetic = 1;
  ledger.accounts.resize(2), ledger.flows.resize(2);
  for (const double work : works) {
    ledger.accounts[1].work += work;
    ledger.accounts[1].stored[Stored::penalty] = created - ledger.accounts[1].work;
    update_flows(ledger);
  }
  return ledger;
}

TEST(Flow, IsTheSumOfWhatPassedInBothDirections) {
  const Ledger ledger = after({-0.3, -0.2, 0.4, 0}, 0);
  EXPECT_DOUBLE_EQ(ledger.flows[1].passed, 0.9);
  EXPECT_DOUBLE_EQ(ledger.flows[1].recent, 0.2);  // half of the step before
  EXPECT_EQ(ledger.flows[0].passed, 0);
  EXPECT_EQ(ledger.flows[1].worst, 0);
}

TEST(SpuriousPart, IsHeldAgainstWhatPassedThroughThatSourceWithBothSigns) {
  const double tiny = 1e-3;  // of the scene: no limit on the scene's scale sees it
  for (const double part : {0.5, -0.5}) {
    const Ledger ledger = after({-tiny, tiny, 0, 0, 0, 0, 0, 0, 0, 0}, part * 2 * tiny);
    EXPECT_NEAR(spurious_part(ledger, 1), part, 1. / 256);  // 2^-8 of the last work may still come back
    EXPECT_EQ(ledger.flows[1].worst, spurious_part(ledger, 1));
    EXPECT_EQ(spurious_part(ledger, 0), 0);
  }
}

TEST(SpuriousPart, CountsALittleFlowAsAThousandthOfTheScene) {
  const double little = 0.1 * least_flow;  // passes in each of both directions
  const Ledger ledger = after({-little, little, 0, 0, 0, 0, 0, 0, 0, 0}, 0.5 * little);
  EXPECT_NEAR(spurious_part(ledger, 1), 0.05, 1e-3);
}

TEST(SpuriousPart, DoesNotCountWhatTheNextStepsMayMakeGood) {
  EXPECT_EQ(spurious_part(after({-0.01}, 0.01), 1), 0);
  EXPECT_NEAR(spurious_part(after({-0.01, 0}, 0.01), 1), 0.5, 1e-12);
  EXPECT_NEAR(spurious_part(after({-0.01, 0, 0}, 0.01), 1), 0.75, 1e-12);
}

TEST(SpuriousPart, DoesNotCountWhatAContactStillOwesUpToWhatMayBeCreatedUnseen) {
  Ledger ledger = after({-0.01, 0.01}, 0.002);  // of 0.02 that passed
  ledger.flows[1].recent = 0;
  EXPECT_NEAR(spurious_part(ledger, 1), 0.1, 1e-6);
  ledger.flows[1].deficit = 0.5 * least_share;
  EXPECT_NEAR(spurious_part(ledger, 1), 0.1 - 0.5 * least_share / 0.02, 1e-6);
  ledger.flows[1].deficit = 0.002;
  EXPECT_NEAR(spurious_part(ledger, 1), 0.1 - least_share / 0.02, 1e-6);
  ledger.accounts[1].stored[Stored::penalty] -= 0.004;  // lost
  EXPECT_NEAR(spurious_part(ledger, 1), -0.1, 1e-6) << "what is lost is no debt";
}

TEST(SpuriousPart, LeavesOutChatterAndScenesInWhichNothingMoved) {
  EXPECT_EQ(spurious_part(after({0.4 * least_share, -0.4 * least_share, 0}, 0.1), 1), 0);
  EXPECT_NE(spurious_part(after({0.6 * least_share, -0.6 * least_share, 0}, 0.1), 1), 0);
  Ledger still = after({1, 0}, 0.5);
  still.initial_available = still.initial_kinetic = 0;
  EXPECT_EQ(spurious_part(still, 1), 0);
  still.integration_kept = 1;
  EXPECT_EQ(kept_part(still), 0);
}

TEST(SpuriousPart, IsToldWithItsAmountsWhereItIsMoreThanALittleOfTheScene) {
  const Ledger little = after({6e-5, -6e-5, 0, 0, 0, 0, 0, 0}, 1.2e-5);  // as 7 uJ of 60 uJ in a scene of 0.6 J
  EXPECT_GT(little.flows[1].worst, 0.01);
  EXPECT_EQ(little.flows[1].told.part, 0);
  const Ledger much = after({5e-3, -5e-3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 1.2e-3);
  EXPECT_EQ(much.flows[1].told.part, much.flows[1].worst);
  EXPECT_NEAR(much.flows[1].told.part, 0.12, 1e-3);
  EXPECT_DOUBLE_EQ(much.flows[1].told.energy, 1.2e-3);
  EXPECT_DOUBLE_EQ(much.flows[1].told.passed, 0.01);
}

TEST(SpuriousPart, OfRoundOffAtAStartFromRestIsHeldAgainstTheFloor) {
  Ledger ledger = after({-1e-27, 1e-27, 0, 0, 0, 0}, 0.5e-27);
  ledger.initial_available = ledger.initial_kinetic = 0, ledger.external_work = 1e-27;
  EXPECT_GT(spurious_part(ledger, 1), 0.2) << "without a floor";
  ledger.size = 0.1, ledger.largest_force = 1e-6;
  EXPECT_EQ(spurious_part(ledger, 1), 0);
  ledger.accounts[1].work += 1e-10, update_flows(ledger);  // more than passes unseen: 2.5e-3 of the floor
  ledger.flows[1].recent = 0;
  EXPECT_GT(spurious_part(ledger, 1), 0.2);
}

TEST(KeptPart, IsThatOfTheIntegrationOverTheScaleWithBothSigns) {
  Ledger ledger = after({}, 0);
  ledger.initial_available = ledger.initial_kinetic = 4, ledger.integration_kept = ledger.integration = -1;
  update_flows(ledger);
  EXPECT_EQ(kept_part(ledger), -0.25);
  ledger.integration_kept = ledger.integration = 0.5;
  update_flows(ledger);
  EXPECT_EQ(ledger.worst_kept, -0.25);
}

TEST(KeptPart, LeavesOutWhatTheForcesNowMakeUpFor) {
  Ledger ledger = after({}, 0);
  ledger.initial_available = ledger.initial_kinetic = 4, ledger.integration_kept = -1;
  for (const auto& [integration, part] : {std::pair{0.3, 0.0}, {0.0, 0.0}, {-0.4, -0.1}, {-1.0, -0.25}, {-3.0, -0.25}}) {
    ledger.integration = integration;
    EXPECT_EQ(kept_part(ledger), part) << integration;
  }
}

TEST(SwingPart, IsWhatComesBackOverTheScaleAtUpdatesOfTheLedger) {
  Ledger ledger = after({}, 0);
  ledger.initial_available = 4, ledger.integration = 2;
  update_created(ledger);
  EXPECT_EQ(swing_part(ledger), 0.5);
  ledger.integration = 0;
  update_created(ledger);
  EXPECT_EQ(swing_part(ledger), 0.5);
  ledger.external_work = 8;
  EXPECT_EQ(swing_part(ledger), 0.25);
}

TEST(EnergyScale, IsThatOfTheCommonCentreWhereNothingActsFromOutside) {
  Ledger ledger;
  ledger.initial_kinetic = 10, ledger.initial_available = 4;
  EXPECT_EQ(energy_scale(ledger), 4);
  ledger.initial_available = 1e-17;
  EXPECT_NEAR(energy_scale(ledger), 1e-5, 1e-20) << "a scene that only flies by";
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
}  // namespace nereid::dynamics::ledger_test
