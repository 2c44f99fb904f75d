// What gmsh itself seldom writes: sparse numbers, foreign byte order, other data sizes, mistakes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "io/gmsh.hpp"
#include "mesh_support.hpp"

namespace cleave::io::testing {
namespace {

using Numbers = std::vector<std::int64_t>;

Mesh read_text(const std::string& text) { return gmsh::read("m.msh", text); }

const std::string kFormat22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kFormat41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";

std::string nodes22(const Numbers& ids) {
  const std::vector<std::string> places = {"0 0 0", "1 0 0", "1 1 0", "0 1 0"};
  std::string text = "$Nodes\n" + std::to_string(ids.size()) + "\n";
  for (std::size_t i = 0; i < ids.size(); ++i)
    text += std::to_string(ids[i]) + " " + places[i % places.size()] + "\n";
  return text + "$EndNodes\n";
}

std::string elements22(const std::vector<std::string>& lines) {
  std::string text = "$Elements\n" + std::to_string(lines.size()) + "\n";
  for (const std::string& line : lines) text += line + "\n";
  return text + "$EndElements\n";
}

TEST(GmshText, SparseNumbersAndUnusedNodes) {
  for (const Numbers& ids :
       {Numbers{10, 30, 20, 7}, Numbers{5, 4000000000, 70, 900000000000000000}}) {
    const std::string a = std::to_string(ids[0]), b = std::to_string(ids[1]),
                      c = std::to_string(ids[2]);
    const Mesh mesh =
        read_text(kFormat22 + nodes22(ids) + elements22({"1 2 2 3 1 " + a + " " + b + " " + c}));
    EXPECT_EQ(mesh.point_ids, ids);
    EXPECT_EQ(mesh.triangles.nodes, (Numbers{0, 1, 2}));
    ASSERT_NE(mesh.find_group("2:3"), nullptr);
    EXPECT_EQ(mesh.find_group("2:3")->nodes, (Numbers{0, 1, 2}));
  }
}

TEST(GmshText, WindowsLineEndsAndComments) {
  std::string text = "$Comments\n anything $Nodes\n$EndComments\n" + kFormat22 +
                     "$PhysicalNames\n1\n2 3 \"my \"plate\"\"\n$EndPhysicalNames\n" +
                     nodes22({1, 2, 3, 4}) + "$NodeData\nx\n$EndNodeData\n" +
                     elements22({"1 2 2 3 1 1 2 3", "2 2 2 -3 1 1 3 4"});
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& given : {text, windows}) {
    const Mesh mesh = read_text(given);
    ASSERT_EQ(mesh.groups.size(), 1U);
    EXPECT_EQ(mesh.groups[0].name, "my \"plate\"");
    EXPECT_EQ(mesh.groups[0].cells, (Numbers{0, 1}));  // a negative tag is the same group
  }
}

TEST(GmshText, NameOfTwoDimensions) {
  const Mesh mesh =
      read_text(kFormat22 + "$PhysicalNames\n2\n1 1 \"side\"\n2 1 \"side\"\n$EndPhysicalNames\n" +
                nodes22({1, 2, 3}) + elements22({"1 1 2 1 1 1 2", "2 2 2 1 1 1 2 3"}));
  EXPECT_EQ(mesh.find_group("side")->dimension, 2);
  EXPECT_EQ(mesh.find_group("2:side")->dimension, 2);
  EXPECT_EQ(mesh.find_group("1:side")->dimension, 1);
  EXPECT_EQ(mesh.find_group("0:side"), nullptr);
}

TEST(GmshText, EntitiesWithSeveralTags) {
  const Mesh mesh =
      read_text(kFormat41 +
                "$Entities\n0 1 1 0\n4 0 0 0 1 0 0 2 -8 9 0 \n1 0 0 0 1 1 0 0 0 \n"
                "$EndEntities\n$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n"
                "$EndNodes\n$Elements\n2 2 1 2\n1 4 1 1\n1 1 2\n2 1 2 1\n2 1 2 3\n"
                "$EndElements\n");
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_EQ(mesh.groups[0].name, "1:8");
  EXPECT_EQ(mesh.groups[1].name, "1:9");
  for (const MeshGroup& group : mesh.groups) EXPECT_EQ(group.nodes, (Numbers{0, 1}));
}

// The mesh of one triangle in MSH 4.1 binary with counts of type Size, in either byte order.
template <class Size>
std::string binary41(bool swapped) {
  std::string bytes = "$MeshFormat\n4.1 1 " + std::to_string(sizeof(Size)) + "\n";
  const auto put = [&](auto value) {
    std::array<char, sizeof(value)> raw;
    std::memcpy(raw.data(), &value, sizeof(value));
    if (swapped) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
  };
  const auto sizes = [&](std::initializer_list<int> values) {
    for (const int value : values) put(static_cast<Size>(value));
  };
  const auto integers = [&](std::initializer_list<std::int32_t> values) {
    for (const std::int32_t value : values) put(value);
  };
  const auto reals = [&](std::initializer_list<double> values) {
    for (const double value : values) put(value);
  };
  integers({1});
  bytes += "\n$EndMeshFormat\n$Entities\n";
  sizes({0, 0, 1, 0});
  integers({5});
  reals({0, 0, 0, 1, 1, 0});
  sizes({1});
  integers({-6});
  sizes({0});
  bytes += "\n$EndEntities\n$Nodes\n";
  sizes({1, 3, 1, 3});
  integers({2, 5, 0});
  sizes({3, 1, 2, 3});
  reals({0, 0, 0, 1, 0, 0, 0, 1.5, 0});
  bytes += "\n$EndNodes\n$Elements\n";
  sizes({1, 1, 1, 1});
  integers({2, 5, 2});
  sizes({1, 1, 1, 2, 3});
  return bytes + "\n$EndElements\n";
}

TEST(GmshText, ByteOrdersAndDataSizes) {
  const std::vector<std::string> files = {
      binary41<std::uint64_t>(false), binary41<std::uint64_t>(true), binary41<std::uint32_t>(false),
      binary41<std::uint32_t>(true)};
  for (const std::string& file : files) {
    const Mesh mesh = read_text(file);
    EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1.5, 0}));
    EXPECT_EQ(mesh.triangles.nodes, (Numbers{0, 1, 2}));
    ASSERT_EQ(mesh.groups.size(), 1U);
    EXPECT_EQ(mesh.groups[0].name, "2:6");
  }
}

TEST(GmshText, HeaderMistakes) {
  const auto refuse = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_error([&] { read_text(text); }, parts);
  };
  refuse("$MeshFormat\n2.1 0 8\n$EndMeshFormat\n", {"m.msh:2:", "\"2.1\"", "-format msh41"});
  refuse("$MeshFormat\n4.1 2 8\n", {"m.msh:2:", "0 (text) or 1 (binary)"});
  refuse("$MeshFormat\n4.1 0 16\n", {"should be 8 or 4"});
  refuse("$MeshFormat\n2.2 1 4\n", {"should be 8, but is 4"});
  refuse(std::string("$MeshFormat\n4.1 1 8\n\2\0\0\0\n", 25), {"at byte 20", "byte order"});
  refuse(nodes22({1}), {"begins with section $MeshFormat"});
  refuse(kFormat22, {"no section $Nodes"});
  refuse(kFormat22 + nodes22({1}), {"no section $Elements"});
  refuse(kFormat22 + elements22({}), {"before $Nodes"});
  refuse(kFormat22 + "Nodes\n", {"m.msh:4:", "beginning of a section", "    Nodes"});
  refuse(kFormat22 + "$Periodic\n1\n", {"no $EndPeriodic", "truncated"});
}

TEST(GmshText, ContentMistakes) {
  const auto refuse = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_error([&] { read_text(kFormat22 + text); }, parts);
  };
  const std::string nodes = nodes22({1, 2, 3});
  refuse("$Nodes\n2\n1 0 0 0\n2 0 zero 0\n$EndNodes\n", {"m.msh:7:", "a real number", "\"zero\""});
  refuse("$Nodes\n1\n1 0 nan 0\n$EndNodes\n", {"not finite"});
  refuse("$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", {"node 1 occurs twice"});
  refuse("$Nodes\n2\n1 0 0 0\n-2 1 0 0\n$EndNodes\n", {"negative"});
  refuse("$Nodes\n1\n1 0 0 0\n2 1 0 0\n$EndNodes\n", {"m.msh:7:", "$EndNodes"});
  refuse("$Nodes\n999999999999\n1 0 0 0\n$EndNodes\n", {"announces 999999999999 nodes", "bytes"});
  refuse("$Nodes\n-1\n$EndNodes\n", {"announces -1 nodes"});
  refuse("$Nodes\n3\n1 0 0 0\n2 0.00000000 0.00000", {"ends inside section $Nodes"});
  refuse(nodes + elements22({"1 2 2 1 1 1 2 9"}), {"m.msh:12:", "element 1 refers to node 9"});
  refuse(nodes + elements22({"1 34 2 1 1 1 2 3"}), {"type 34 is not known"});
  refuse(nodes + elements22({"1 2 2000 1 1 1 2 3"}), {"announces 2000 tags"});
  refuse(nodes + elements22({"1 2 2 99999999999 1 1 2 3"}), {"at most 31 bits"});
  refuse(nodes + "$PhysicalNames\n1\n2 1 plate\n$EndPhysicalNames\n", {"double quotes"});
  refuse(nodes + "$PhysicalNames\n1\n4 1 \"plate\"\n$EndPhysicalNames\n", {"0 to 3, not 4"});
}

TEST(GmshText, GarbageIsRefused) {
  const std::string path = scratch_path("garbage");
  write_bytes(path, "");
  expect_error([&] { read_mesh(path); }, {"empty", "$MeshFormat"});
  write_bytes(path, "solid cube\nfacet normal 0 0 1\n");
  expect_error([&] { read_mesh(path); }, {"not a mesh file", "Gmsh MSH 2.2 or 4.1", "Exodus II"});
  std::remove(path.c_str());
}

}  // namespace
}  // namespace cleave::io::testing
