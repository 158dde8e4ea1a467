#include "grid/vtu_check.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace nereid::grid::vtu_check_test {
namespace {

std::string base64(const std::string& bytes) {
  const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b) three = (three << 8U) | (at + b < bytes.size() ? static_cast<unsigned char>(bytes[at + b]) : 0U);
    for (std::size_t letter = 0; letter < 4; ++letter)
      text += at + letter > bytes.size() ? '=' : letters[(three >> (18 - 6 * letter)) & 63U];
  }
  return text;
}

/// Numbers as four bytes each, the lowest first.
std::string words(const std::vector<std::uint32_t>& numbers) {
  std::string bytes;
  for (const std::uint32_t number : numbers)
    for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((number >> shift) & 0xFFU);
  return bytes;
}

struct Parts {
  std::string file = "type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"";
  std::string piece = "NumberOfPoints=\"3\" NumberOfCells=\"1\"";
  std::string points = "format=\"ascii\">0 0 0 1 0 0 0 1 0";  // the last attributes of the array, and what is in it
  std::string region = "type=\"Int32\" Name=\"region\" format=\"ascii\">7";
  std::string behind = "";
};

/// One triangle.
std::string text_of(const Parts& parts) {
  return "<?xml version=\"1.0\"?>\n<VTKFile " + parts.file + ">\n<UnstructuredGrid>\n<Piece " + parts.piece + ">\n<CellData>\n<DataArray " +
         parts.region + "</DataArray>\n</CellData>\n<Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" " + parts.points +
         "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>\n" +
         "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray>\n" +
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n" +
         parts.behind + "</VTKFile>\n";
}

std::string fault(const Parts& parts) { return check_vtu(text_of(parts)).fault; }

constexpr const char* appended = "format=\"appended\" offset=\"0\">";

std::string appended_data(const std::string& encoding, const std::string& data) {
  return "<AppendedData encoding=\"" + encoding + "\">\n_" + data + "\n</AppendedData>\n";
}

TEST(CheckVtu, TakesSoundFilesInEveryForm) {
  const std::string plain = words({36}) + std::string(36, '\1');
  const std::string packed_head = words({2, 24, 12, 6, 5}), packed = std::string(11, '\1');
  EXPECT_EQ(fault({}), "");
  EXPECT_EQ(fault({.points = "format=\"binary\">\n  " + base64(plain) + "\n"}), "");
  EXPECT_EQ(fault({.points = appended, .behind = appended_data("raw", plain)}), "");
  EXPECT_EQ(fault({.points = appended, .behind = appended_data("base64", base64(plain))}), "");
  const std::string file = Parts().file + " compressor=\"vtkZLibDataCompressor\"";
  EXPECT_EQ(fault({.file = file, .points = "format=\"binary\">" + base64(packed_head) + base64(packed)}), "");
  EXPECT_EQ(fault({.file = file, .points = appended, .behind = appended_data("raw", packed_head + packed)}), "");
  EXPECT_EQ(fault({.file = file, .points = appended, .behind = appended_data("base64", base64(packed_head) + base64(packed))}), "");
  EXPECT_GE(check_vtu(text_of({})).unpacked, 36);
}

TEST(CheckVtu, TakesOtherByteOrdersAndHeads) {
  EXPECT_EQ(fault({.file = "type=\"UnstructuredGrid\" byte_order=\"BigEndian\" header_type=\"UInt64\"",
                   .points = "format=\"binary\">" + base64(std::string(7, '\0') + '\x24' + std::string(36, '\1'))}),
            "");
}

TEST(CheckVtu, TellsThePlaceAndWhatWasExpected) {
  EXPECT_EQ(fault({.piece = "NumberOfPoints=\"-3\" NumberOfCells=\"1\""}),
            "it is damaged in line 4: NumberOfPoints = '-3' of its 'Piece' is no whole number from 0 to 2147483647");
  EXPECT_EQ(fault({.region = "type=\"Int33\" Name=\"region\" format=\"ascii\">7"}),
            "it is damaged in line 6: type = 'Int33' of its 'DataArray' is unknown: expected none, Int8, UInt8, Int16, UInt16, Int32, "
            "UInt32, Float32, Int64, UInt64, Float64, String, Bit");
  EXPECT_EQ(fault({.points = "format=\"ascii\">0 0 0 1 0 0 0 1"}),
            "it is damaged in line 9: an array without a name has fewer values than the 9 that its counts ask for");
}

TEST(CheckVtu, RefusesCountsThatTheDataDoNotHave) {
  EXPECT_NE(fault({.piece = "NumberOfPoints=\"2000000000\" NumberOfCells=\"1\""}), "");
  EXPECT_NE(fault({.piece = "NumberOfPoints=\"3\" NumberOfCells=\"2\""}), "");
  EXPECT_NE(fault({.piece = "NumberOfPoints=\"1e3\" NumberOfCells=\"1\""}), "");
  EXPECT_NE(fault({.region = "type=\"Int32\" Name=\"region\" NumberOfComponents=\"0\" format=\"ascii\">7"}), "");
  EXPECT_NE(fault({.region = "type=\"Int32\" Name=\"region\" NumberOfComponents=\"999999999\" format=\"ascii\">7"}), "");
  EXPECT_NE(fault({.region = "type=\"Int32\" Name=\"region\" format=\"binary\">"}), "");
}

TEST(CheckVtu, RefusesSizesBeyondTheFile) {
  const std::string rest(36, '\1');
  EXPECT_NE(fault({.points = "format=\"binary\">" + base64(words({0xFFFFFFF0U}) + rest)}), "");
  EXPECT_NE(fault({.points = "format=\"binary\">" + base64(words({35}) + rest)}), "");  // fewer than three points have
  EXPECT_NE(fault({.points = appended, .behind = appended_data("raw", words({1000}) + rest)}), "");
  EXPECT_NE(fault({.points = "format=\"appended\" offset=\"999999\">", .behind = appended_data("raw", words({36}) + rest)}), "");
  EXPECT_NE(fault({.points = "format=\"appended\" offset=\"-1\">", .behind = appended_data("raw", words({36}) + rest)}), "");
  EXPECT_NE(fault({.points = appended}), "");  // there are no appended data
  const std::string file = Parts().file + " compressor=\"vtkZLibDataCompressor\"";
  const std::vector<std::vector<std::uint32_t>> heads{{0xFFFFFFFFU, 24, 12, 6}, {1, 24, 12, 60},         {1, 24, 25, 6}, {1},
                                                      {2, 24, 12, 6},           {1, 0xFFFFFFFFU, 36, 6}, {0}};
  for (const std::vector<std::uint32_t>& head : heads)
    EXPECT_NE(fault({.file = file, .points = "format=\"binary\">" + base64(words(head)) + base64("\1\1\1\1\1\1")}), "");
}

TEST(CheckVtu, RefusesTagsThatAreDamaged) {
  const std::string whole = text_of({});
  for (std::size_t length = 0; length + 2 < whole.size(); ++length)
    EXPECT_NE(check_vtu(std::string_view(whole).substr(0, length)).fault, "") << length;
  EXPECT_EQ(check_vtu("").fault, "it is no .vtu file");
  EXPECT_EQ(check_vtu("a picture").fault, "it is no .vtu file");
  EXPECT_NE(fault({.file = "type=\"PolyData\""}), "");
  EXPECT_NE(fault({.file = "type=\"UnstructuredGrid\" compressor=\"mine\""}), "");
  EXPECT_NE(fault({.file = "type=\"UnstructuredGrid\" type=\"UnstructuredGrid\""}), "");
  EXPECT_NE(fault({.file = "type=UnstructuredGrid"}), "");
  EXPECT_NE(fault({.behind = "<a>"}), "");
  EXPECT_NE(fault({.behind = "<a></b>"}), "");
  EXPECT_NE(fault({.behind = "<!ENTITY a \"b\">"}), "");
  EXPECT_NE(fault({.behind = "<UnstructuredGrid/>"}), "");
  std::string deep;
  for (int i = 0; i < 1000; ++i) deep += "<a>";
  EXPECT_NE(fault({.behind = deep}), "");
}

TEST(CheckVtu, RefusesTagsOfManyAttributes) {
  std::string many = "<VTKFile";
  for (int i = 0; i < 101; ++i) many += " a" + std::to_string(i) + "='0'";
  EXPECT_NE(check_vtu(many + ">").fault.find("a tag has more than 100 attributes"), std::string::npos) << check_vtu(many + ">").fault;
}

TEST(CheckVtu, ShowsWhatIsNotPrintableAsQuestionMarks) {
  const std::string said = fault({.piece = "NumberOfPoints=\"\1\n\xFF" + std::string(100, '7') + "\" NumberOfCells=\"1\""});
  EXPECT_NE(said.find("= '???7777"), std::string::npos);
}

}  // namespace
}  // namespace nereid::grid::vtu_check_test
