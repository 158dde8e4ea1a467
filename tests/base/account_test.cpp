#include "base/account.hpp"

#include <gtest/gtest.h>

#include <set>

namespace nereid::account_test {
namespace {

TEST(Account, EveryChannelHasAWordOfItsOwn) {
  EXPECT_EQ(std::set(words_of_stored.begin(), words_of_stored.end()).size(), words_of_stored.size());
  EXPECT_EQ(std::set(words_of_dissipated.begin(), words_of_dissipated.end()).size(), words_of_dissipated.size());
  EXPECT_EQ(word(Stored::elastic), "elastic");
  EXPECT_EQ(word(Stored::drilling), "drilling");
  EXPECT_EQ(word(Stored::external_work), words_of_stored.back());
  EXPECT_EQ(word(Dissipated::radiated), words_of_dissipated.back());
  EXPECT_EQ(word(SourceKind::gravity), words_of_source_kinds.back());
}

TEST(Account, WhatAStoreHoldsCountsFromTheStart) {
  Account account;
  account.at_start[Stored::elastic] = 3;
  account.hold(Stored::elastic, 5);
  EXPECT_EQ(account.stored[Stored::elastic], 2);
  EXPECT_EQ(account.stored[Stored::hourglass], 0);
}

}  // namespace
}  // namespace nereid::account_test
