#include "command/info.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "io/archive.hpp"
#include "io/error.hpp"
#include "io/record_table.hpp"
#include "io/results.hpp"

namespace cleave::driver {
namespace {

std::string path_of(const std::string& name) { return ::testing::TempDir() + "info_test_" + name; }

void expect_said(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << '\n' << text;
}

TEST(Info, DescribesCheckpoints) {
  io::Archive archive;
  archive.attributes = {
      {"step", std::int64_t{120}}, {"deck", "&run\n  t_end = 1\n/\n"}, {"time", 0.5}};
  archive.arrays = {{"body/velocity", "m s-1", "velocity v", 3, std::vector<double>(12, 1.0)}};
  io::write_archive(path_of("a.chk"), archive);
  expect_said(file_description(path_of("a.chk")),
              {": checkpoint", "120", "0.5", "body/velocity", "[m s-1]", "3 x 4", "velocity v",
               "&run ... (19 characters)"});
}

TEST(Info, DescribesResults) {
  io::ResultLayout layout;
  layout.title = "a triangle";
  layout.dimension = 2;
  layout.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  layout.point_ids = {1, 2, 3};
  layout.blocks = {{"plate", io::CellKind::triangle, {0, 1, 2}}};
  layout.nodal = {{"damage", "1", "damage"}};
  io::ResultsWriter writer = io::ResultsWriter::create(path_of("a.e"), layout);
  const std::vector<std::vector<double>> nodal = {{0, 0, 1}};
  writer.write_frame(0.25, nodal, {}, {});
  writer.write_frame(0.75, nodal, {}, {});
  expect_said(file_description(path_of("a.e")),
              {": results", "a triangle", "dimension 2, 3 particles, 1 elements",
               "2 frames, time 0.25 to 0.75", "damage"});
}

TEST(Info, DescribesHistories) {
  {
    io::RecordTable table = io::RecordTable::create(
        path_of("a.nc"), "", {{"step", "1", "step", true}, {"time", "s", "simulated time", false}},
        {});
    table.append(std::vector<double>{0, 0});
    table.append(std::vector<double>{40, 0.5});
    table.flush();
  }
  expect_said(file_description(path_of("a.nc")),
              {"table of 2 records", "step", "40", "time", "[s]", "0.5", "simulated time"});
}

TEST(Info, RefusesOtherFiles) {
  std::ofstream(path_of("a.txt")) << "not a file of a run\n";
  try {
    file_description(path_of("a.txt"));
    FAIL() << "a text was described";
  } catch (const io::Error& error) {
    expect_said(error.what(),
                {"none of the files that a run writes", "not a checkpoint", "not results"});
  }
}

}  // namespace
}  // namespace cleave::driver
