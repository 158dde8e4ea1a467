#include "grid/file_sets.hpp"

#include <gtest/gtest.h>

namespace nereid::grid::file_sets_test {
namespace {

Contents with_array(const std::string& name, const std::vector<double>& values, bool integer = true) {
  Contents file;
  const auto points = static_cast<Eigen::Index>(values.size());
  file.points = Vectors::Zero(3, points);
  file.point_fields = {Field{name, "", {}, Eigen::Map<const Eigen::MatrixXd>(values.data(), 1, points), integer}};
  return file;
}

/// The sets, as in "foot 0 3", and what is doubted, behind a "?".
std::vector<std::string> said(const Contents& file) {
  std::vector<std::string> all, warnings;
  for (const FileSet& set : point_sets(file, warnings)) {
    std::string& text = all.emplace_back(set.name);
    for (const Index point : set.points) text += " " + std::to_string(point);
  }
  for (const std::string& warning : warnings) all.push_back("?" + warning.substr(0, warning.find(',')));
  return all;
}

using Said = std::vector<std::string>;

TEST(PointSets, AreArraysOfZeroAndOneOfAnyType) {
  EXPECT_EQ(said(with_array("foot", {1, 0, 0, 1})), Said{"foot 0 3"});
  EXPECT_EQ(said(with_array("foot", {1, 0, 0, 1}, false)), Said{"foot 0 3"});
  EXPECT_EQ(said(with_array("foot", {0, 0, 0, 0})), Said{});
  EXPECT_EQ(said(with_array("vtkGhostType", {1, 0, 0, 1})), Said{});
  EXPECT_EQ(said(with_array("temperature", {0, 0.5, 1, 1}, false)), Said{});
  EXPECT_EQ(said(with_array("temperature", {1, 1, 1, 1}, false)), Said{}) << "a result that is the same everywhere";
}

TEST(PointSets, AreThoseThatMeshioJoins) {
  EXPECT_EQ(said(with_array("foot", {0, -1, -1, 0})), Said{"foot 0 3"});
  EXPECT_EQ(said(with_array("left-foot", {0, -1, -1, 0})), Said{"left-foot 0 3"}) << "one set, whatever its name";
  const std::string doubt = "?its point array 'foot-head' holds the sets foot";
  EXPECT_EQ(said(with_array("foot-head", {0, -1, 1, 0})), (Said{"foot 0 3", "head 2", doubt}));
  EXPECT_EQ(said(with_array("footfoot-headhead", {0, -1, 1, 0})),
            (Said{"foot 0 3", "head 2", "?its point array 'footfoot-headhead' holds the sets foot"}));  // as some of its versions do
  EXPECT_EQ(said(with_array("aa-b-cba-b-cc", {0, 1, 2, -1})),
            (Said{"a 0", "b 1", "c 2", "?its point array 'aa-b-cba-b-cc' holds the sets a"}));
  EXPECT_EQ(said(with_array("a_x-b-c", {0, 1, 2, -1})).size(), 4U) << "by the one letter that makes three names";
}

TEST(PointSets, TellsWhatLooksLikeSetsAndIsNone) {
  const auto doubts = [](const char* name) { return Said{"?its point array '" + std::string(name) + "' looks like sets of points"}; };
  EXPECT_EQ(said(with_array("part", {3, 3, 7, 7})), doubts("part"));
  EXPECT_EQ(said(with_array("foot", {0, 1, 2, -1})), doubts("foot")) << "three sets and one name";
  EXPECT_EQ(said(with_array("a-b_c", {0, 1, -1, -1})), doubts("a-b_c")) << "a and b_c, or a-b and c";
  EXPECT_EQ(said(with_array("part", {3, 3, 7, 7}, false)), Said{}) << "a result";
  std::vector<double> numbers(100);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i);
  EXPECT_EQ(said(with_array("node_id", numbers)), Said{});
  EXPECT_EQ(said(with_array("node_id", {2, 0, 1, 3})), Said{}) << "each point has a number of its own";
}

TEST(GroupNames, AreArraysOfANumberAndADimension) {
  Contents file;
  file.fields = {Field{"edge", "", {}, (Eigen::MatrixXd(1, 2) << 5, 1).finished(), true},
                 Field{"TimeValue", "", {}, Eigen::MatrixXd::Zero(1, 1), false}};
  EXPECT_EQ(group_names(file, 1), (std::map<int, std::string>{{5, "edge"}}));
  EXPECT_TRUE(group_names(file, 2).empty());
}

}  // namespace
}  // namespace nereid::grid::file_sets_test
