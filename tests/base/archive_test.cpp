#include "base/archive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nereid::archive_test {
namespace {

enum class Kind : int { one = 1, other = 2 };

struct Part {
  double number = 0;
  std::array<Vec3, 2> places{Vec3::Zero(), Vec3::Zero()};
};

struct Whole {
  bool flag = false;
  Kind kind = Kind::one;
  std::int64_t count = 0;
  std::string text;
  std::vector<char> flags;
  std::vector<Part> parts;
  Scalars scalars;
  Vectors vectors;
  Mat3 matrix = Mat3::Zero();
};

template <class Archive>
void visit(Archive& archive, Part& part) {
  auto& [number, places] = part;
  archive(number, places);
}

template <class Archive>
void visit(Archive& archive, Whole& whole) {
  auto& [flag, kind, count, text, flags, parts, scalars, vectors, matrix] = whole;
  archive(flag, kind, count, text, flags, parts, scalars, vectors, matrix);
}

Whole example() {
  Whole whole{true, Kind::other, -7, "two words", {1, 0, 1}, {{}, {}}, Scalars::LinSpaced(3, 0, 1), Vectors::Random(3, 4), Mat3::Random()};
  whole.parts[1].number = std::numeric_limits<double>::quiet_NaN();
  whole.parts[1].places[1] = Vec3(1e-320, -0.0, 3);
  return whole;
}

TEST(Archive, ReadsBackWhatWasWritten) {
  const Whole before = example();
  Writer writer;
  writer(before, 0.5);
  Reader reader(writer.bytes());
  Whole after;
  double half = 0;
  reader(after, half);
  EXPECT_TRUE(reader.is_at_end());
  EXPECT_EQ(half, 0.5);
  EXPECT_EQ(after.flag, before.flag);
  EXPECT_EQ(after.kind, before.kind);
  EXPECT_EQ(after.count, before.count);
  EXPECT_EQ(after.text, before.text);
  EXPECT_EQ(after.flags, before.flags);
  ASSERT_EQ(after.parts.size(), 2U);
  EXPECT_TRUE(std::isnan(after.parts[1].number));
  EXPECT_EQ(after.parts[1].places[1], before.parts[1].places[1]);
  EXPECT_TRUE(std::signbit(after.parts[1].places[1].y()));
  EXPECT_EQ(after.scalars, before.scalars);
  EXPECT_EQ(after.vectors, before.vectors);
  EXPECT_EQ(after.matrix, before.matrix);
}

TEST(Archive, ReadsBackEachKindOfAVariant) {
  using Any = std::variant<Part, Whole>;
  const std::vector<Any> before{Part{.number = 3}, example(), Part{.number = 4}};
  Writer writer;
  writer(before);
  std::vector<Any> after;
  Reader reader(writer.bytes());
  reader(after);
  EXPECT_TRUE(reader.is_at_end());
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(std::get<Part>(after[0]).number, 3);
  EXPECT_EQ(std::get<Whole>(after[1]).text, "two words");
  EXPECT_EQ(std::get<Part>(after[2]).number, 4);
  std::string bytes = writer.bytes();
  bytes[sizeof(std::uint64_t)] = 2;  // the kind of the first, of two kinds
  Reader damaged(bytes);
  EXPECT_THROW(damaged(after), DamagedArchive);
}

TEST(Archive, ThatIsCutShortIsDamagedWhereverItEnds) {
  Writer writer;
  writer(example());
  for (std::size_t size = 0; size < writer.bytes().size(); ++size) {
    Reader reader(std::string_view(writer.bytes()).substr(0, size));
    Whole whole;
    EXPECT_THROW(reader(whole), DamagedArchive) << size;
  }
}

TEST(Archive, WithACountThatIsTooLargeTakesNoMemory) {
  Writer writer;
  writer(std::numeric_limits<std::uint64_t>::max(), 1.0);
  std::vector<double> numbers;
  EXPECT_THROW(Reader(writer.bytes())(numbers), DamagedArchive);
  Writer matrix;
  matrix(std::int64_t{3}, std::int64_t{1} << 60, 1.0);
  Vectors vectors;
  EXPECT_THROW(Reader(matrix.bytes())(vectors), DamagedArchive);
}

}  // namespace
}  // namespace nereid::archive_test
