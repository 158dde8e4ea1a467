#include "contact/data/any.hpp"

#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

namespace nereid::contact::any_test {
namespace {

Interface named(const char* name, Pass pass) {
  Interface one;
  one.name = name, one.pass = pass;
  return one;
}
EdgeContact edges_named(const char* name) {
  EdgeContact one;
  one.name = name;
  return one;
}

TEST(AnyContact, GoesWithTheMemoryAndTheWorkspaceOfItsKind) {
  const std::vector<AnyContact> contacts{named("touch", Pass::forth), named("touch_back", Pass::back), edges_named("touch_edges")};
  std::vector<AnyMemory> memories{Memory(), Memory(), EdgeMemory()};
  int apexes = 0, edges = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    AnyWorkspace workspace = make_workspace(contacts[c]);
    with_all(contacts[c], memories[c], workspace, [&](const auto& contact, auto& memory, auto& work) {
      using Kind = std::decay_t<decltype(contact)>;
      static_assert(std::is_same_v<std::decay_t<decltype(memory)>, MemoryOf<Kind>>);
      static_assert(std::is_same_v<std::decay_t<decltype(work)>, WorkspaceOf<Kind>>);
      memory.work = static_cast<double>(contact.name.size());
      ++(std::is_same_v<Kind, Interface> ? apexes : edges);
    });
    EXPECT_EQ(sides(memories[c]).work, static_cast<double>(sides(contacts[c]).name.size()));
  }
  EXPECT_EQ(apexes, 2);
  EXPECT_EQ(edges, 1);
}

TEST(AnyContact, SaysWhichIsAPartOfTheOneBefore) {
  const std::vector<AnyContact> contacts{named("touch", Pass::forth), named("touch_back", Pass::back), edges_named("touch_edges")};
  EXPECT_FALSE(follows(contacts[0]));
  EXPECT_TRUE(follows(contacts[1]));
  EXPECT_TRUE(follows(contacts[2]));
  EXPECT_EQ(side_of(contacts[0]), 1);
  EXPECT_EQ(side_of(contacts[1]), -1);
  EXPECT_EQ(passes_of(contacts), 2U);
  EXPECT_TRUE(by_multipliers(contacts[2]));
  EXPECT_EQ(interface_of(contacts[2]), nullptr);
}

}  // namespace
}  // namespace nereid::contact::any_test
