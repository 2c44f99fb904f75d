#include "io/results.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>
#include <limits>
#include <random>

#include "file_size_limit.hpp"
#include "io/error.hpp"
#include "io/exodus_definition.hpp"
#include "killed_child.hpp"
#include "scratch_folder.hpp"

// The Exodus library forgets a buffer when it finds the disk full; the leak check would report it.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:ex_put_sets\n"; }

namespace {

using namespace cleave::io;

// A square of two triangles, a rod, two lone particles.
ResultLayout plate() {
  ResultLayout layout;
  layout.title = "plate";
  layout.dimension = 2;
  layout.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 3, 0, 0, 4, 0, 0};
  layout.point_ids = {11, 12, 13, 14, 25, 26};
  layout.blocks = {{"plate", CellKind::triangle, {0, 1, 2, 0, 2, 3}},
                   {"empty", CellKind::tetrahedron, {}},
                   {"rod", CellKind::line, {3, 4}},
                   {"dust", CellKind::point, {4, 5}}};
  layout.node_sets = {{"left", 0, {0, 3}, {}}, {"nothing", 0, {}, {}}};
  layout.nodal = {{"DISPLX", "m", "displacement"}, {"DISPLY", "m", "displacement"}};
  layout.element = {{"status", "1", "1 whole, 0 deleted"}};
  layout.global = {{"kinetic", "J", "kinetic energy"}, {"dt", "s", "time step"}};
  layout.information = {{"units", "SI"}};
  return layout;
}

void write_frame(ResultsWriter& results, std::int64_t frame) {
  const auto f = static_cast<double>(frame);
  std::vector<std::vector<double>> nodal(2, std::vector<double>(6)),
      element(1, std::vector<double>(5));
  for (std::size_t i = 0; i < 6; ++i) {
    nodal[0][i] = f / 3 + static_cast<double>(i);
    nodal[1][i] = i == 2 ? std::numeric_limits<double>::quiet_NaN() : -nodal[0][i];
  }
  for (std::size_t i = 0; i < 5; ++i) element[0][i] = i < static_cast<std::size_t>(frame) ? 0 : 1;
  results.write_frame(0.1 * f, nodal, element, std::vector{f * f, 1e-9});
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Results : public testing::Test {
 protected:
  std::string expected(std::int64_t frames) {
    ResultsWriter results = ResultsWriter::create(folder_.file("expected.exo"), plate());
    for (std::int64_t i = 0; i < frames; ++i) write_frame(results, i);
    return bytes_of(folder_.file("expected.exo"));
  }
  ScratchFolder folder_;
  std::string path_ = folder_.file("plate.exo");
};

TEST_F(Results, SummaryTellsWhatWasWritten) {
  ResultsWriter results = ResultsWriter::create(path_, plate());
  EXPECT_EQ(summarise_results(path_).times.size(), 0u);
  for (int i = 0; i < 3; ++i) write_frame(results, i);
  EXPECT_EQ(results.frames(), 3);
  const ResultSummary summary = summarise_results(path_);
  EXPECT_EQ(summary.title, "plate");
  EXPECT_EQ(summary.dimension, 2);
  EXPECT_EQ(summary.points, 6);
  EXPECT_EQ(summary.elements, 5);
  EXPECT_EQ(summary.times, (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(summary.nodal, (std::vector<std::string>{"DISPLX", "DISPLY"}));
  EXPECT_EQ(summary.element, (std::vector<std::string>{"status"}));
  EXPECT_EQ(summary.global, (std::vector<std::string>{"kinetic", "dt"}));
}

TEST_F(Results, MayHaveNoVariablesAndNoElements) {
  ResultLayout layout;
  layout.points = {0, 0, 0};
  layout.point_ids = {1};
  ResultsWriter results = ResultsWriter::create(path_, layout);
  results.write_frame(0.5, {}, {}, {});
  EXPECT_EQ(summarise_results(path_).times, std::vector<double>{0.5});
  layout.element = {{"status", "1", ""}};
  ResultsWriter without_elements = ResultsWriter::create(path_, layout);
  without_elements.write_frame(0.5, {}, std::vector<std::vector<double>>(1), {});
  EXPECT_EQ(summarise_results(path_).element.size(), 0u);
  EXPECT_EQ(ResultsWriter::reopen(path_, layout, 1).frames(), 1);
}

TEST_F(Results, LongNamesAndTitles) {
  ResultLayout layout = plate();
  layout.title = std::string(200, 't');
  layout.nodal[0].name = std::string(255, 'n');
  layout.blocks[0].name = std::string(40, 'b');
  { const ResultsWriter results = ResultsWriter::create(path_, layout); }
  const ResultSummary summary = summarise_results(path_);
  EXPECT_EQ(summary.title, std::string(80, 't'));
  EXPECT_EQ(summary.nodal[0], std::string(255, 'n'));
  EXPECT_EQ(summary.nodal[1], "DISPLY");
  layout.nodal[0].name += 'n';
  EXPECT_TRUE(contains(error_of<Error>([&] { ResultsWriter::create(path_, layout); }),
                       "has a name of 256 characters; allowed are 1 to 255"));
  // A file with short names after one with long ones: nothing of the first is left in the library.
  { const ResultsWriter results = ResultsWriter::create(path_, plate()); }
  EXPECT_TRUE(bytes_of(path_) == expected(0));
}

TEST_F(Results, ContinuesAsIfItHadNeverBeenLonger) {
  for (const std::int64_t kept : {0, 1, 4, 6}) {
    {
      ResultsWriter results = ResultsWriter::create(path_, plate());
      for (std::int64_t i = 0; i < 6; ++i) write_frame(results, i);
    }
    ResultsWriter results = ResultsWriter::reopen(path_, plate(), kept);
    EXPECT_TRUE(bytes_of(path_) == expected(kept)) << kept;
    for (std::int64_t i = kept; i < 8; ++i) write_frame(results, i);
    EXPECT_EQ(results.frames(), 8);
    EXPECT_TRUE(bytes_of(path_) == expected(8)) << kept;
  }
}

TEST_F(Results, ReopeningAnotherFileIsAnError) {
  {
    ResultsWriter results = ResultsWriter::create(path_, plate());
    write_frame(results, 0);
  }
  const std::string before = bytes_of(path_);
  const auto message = [&](const ResultLayout& layout, std::int64_t frames) {
    return error_of<Error>([&] { ResultsWriter::reopen(path_, layout, frames); });
  };
  EXPECT_TRUE(contains(message(plate(), 2), "has 1 records, 2 are needed to continue"));
  ResultLayout layout = plate();
  layout.points.resize(15);
  layout.point_ids.resize(5);
  layout.blocks.pop_back();
  EXPECT_TRUE(contains(message(layout, 1), "has 6 points, this run has 5"));
  layout = plate();
  layout.blocks.pop_back();
  EXPECT_TRUE(contains(message(layout, 1), "has 5 elements, this run has 3"));
  layout = plate();
  layout.nodal.pop_back();
  EXPECT_TRUE(contains(message(layout, 1),
                       "has 'DISPLX, DISPLY' as nodal variables, this run has 'DISPLX'"));
  layout = plate();
  layout.element[0].name = "damage";
  EXPECT_TRUE(contains(message(layout, 1), "as element variables"));
  layout = plate();
  layout.global.clear();
  EXPECT_TRUE(contains(message(layout, 1), "as global variables"));
  EXPECT_TRUE(bytes_of(path_) == before);
}

TEST_F(Results, RefusesLayoutsThatContradictThemselves) {
  const auto message = [&](auto change) {
    ResultLayout layout = plate();
    change(layout);
    return error_of<Error>([&] { ResultsWriter::create(path_, layout); });
  };
  EXPECT_TRUE(
      contains(message([](ResultLayout& l) { l.dimension = 1; }), "2 or 3 dimensions, not 1"));
  EXPECT_TRUE(
      contains(message([](ResultLayout& l) { l.points.clear(); }), "0 coordinates were given"));
  EXPECT_TRUE(
      contains(message([](ResultLayout& l) { l.point_ids.pop_back(); }), "5 point numbers for 6"));
  EXPECT_TRUE(contains(message([](ResultLayout& l) { l.blocks[0].nodes[1] = 6; }),
                       "block 'plate': node 6 at index 1 is outside 0 to 5"));
  EXPECT_TRUE(contains(message([](ResultLayout& l) { l.node_sets[0].nodes[0] = -1; }),
                       "node set 'left': node -1 at index 0"));
  EXPECT_TRUE(contains(message([](ResultLayout& l) { l.blocks[0].nodes.pop_back(); }),
                       "has 5 nodes, which is not a multiple of 3"));
  EXPECT_TRUE(contains(message([](ResultLayout& l) { l.nodal[1].name = "DISPLX"; }),
                       "two of the nodal variables have the name 'DISPLX'"));
  EXPECT_EQ(folder_.entries(), 0u);
}

TEST_F(Results, RefusesFramesThatDoNotFit) {
  ResultsWriter results = ResultsWriter::create(path_, plate());
  const std::vector<std::vector<double>> nodal(2, std::vector<double>(6)),
      element(1, std::vector<double>(5));
  const std::vector<double> global(2);
  const auto message = [&](auto... arguments) {
    return error_of<Error>([&] { results.write_frame(0, arguments...); });
  };
  EXPECT_TRUE(
      contains(message(element, element, global), "a frame has 1 nodal variables, the file has 2"));
  std::vector<std::vector<double>> short_one = nodal;
  short_one[1].pop_back();
  EXPECT_TRUE(contains(message(short_one, element, global),
                       "nodal variable 'DISPLY' has 5 values, 6 are needed"));
  EXPECT_TRUE(contains(message(nodal, short_one, global),
                       "a frame has 2 element variables, the file has 1"));
  EXPECT_TRUE(
      contains(message(nodal, element, std::vector<double>(3)), "a frame has 3 global values"));
  EXPECT_EQ(results.frames(), 0);
}

TEST_F(Results, AFullDiskLosesOnlyTheFrame) {
  const std::string two = expected(2), three = expected(3);
  for (std::size_t limit = two.size(); limit < three.size(); limit += 7) {
    ResultsWriter results = ResultsWriter::create(path_, plate());
    for (int i = 0; i < 2; ++i) write_frame(results, i);
    {
      const FileSizeLimit full(limit);
      const std::string message = error_of<Error>([&] { write_frame(results, 2); });
      ASSERT_TRUE(contains(message, path_) && contains(message, "File too large")) << message;
    }
    ASSERT_TRUE(bytes_of(path_) == two) << limit;
    write_frame(results, 2);
    ASSERT_TRUE(bytes_of(path_) == three) << limit;
  }
  for (std::size_t limit = 0; limit < expected(0).size(); limit += 101) {
    const FileSizeLimit full(limit);
    const std::string message = error_of<Error>([&] { ResultsWriter::create(path_, plate()); });
    ASSERT_TRUE(contains(message, "File too large")) << limit << ": " << message;
    ASSERT_TRUE(bytes_of(path_) == three);
  }
}

TEST_F(Results, AKillLosesNoFrame) {
  std::mt19937 random(9);
  for (int round = 0; round < 10; ++round) {
    const auto work = [&](auto report) {
      ResultsWriter results = ResultsWriter::create(path_, plate());
      for (int i = 0; i < 60; ++i) {
        write_frame(results, i);
        report();
      }
    };
    const std::int64_t sure = steps_before_kill(work, 1 + 3 * round, random() % 3000);
    ResultsWriter results = ResultsWriter::reopen(path_, plate(), sure);
    ASSERT_TRUE(bytes_of(path_) == expected(sure));
    for (std::int64_t i = sure; i < 60; ++i) write_frame(results, i);
    results.sync();
    ASSERT_TRUE(bytes_of(path_) == expected(60));
  }
}

TEST_F(Results, InformationIsCutIntoRecords) {
  ResultLayout layout;
  layout.information = {
      {"deck", "&run\n/\n"}, {"long", std::string(150, 'a')}, {"umlauts", std::string(72, 'b')}};
  for (int i = 0; i < 10; ++i) layout.information[2].second += "ü";
  const std::vector<std::string> records = information_records(layout);
  ASSERT_EQ(records.size(), 7u);
  EXPECT_EQ(records[0], "deck: &run");
  EXPECT_EQ(records[1], "/");
  EXPECT_EQ(records[2], "");
  EXPECT_EQ(records[3], "long: " + std::string(73, 'a') + "\\");
  EXPECT_EQ(records[4], std::string(77, 'a'));
  EXPECT_EQ(records[5], "umlauts: " + std::string(70, 'b') + "\\");
  EXPECT_EQ(records[6], "bbüüüüüüüüüü");
}

TEST_F(Results, OtherFilesAreRefused) {
  const auto message = [&] { return error_of<Error>([&] { summarise_results(path_); }); };
  EXPECT_TRUE(contains(message(), "No such file or directory"));
  put_bytes(path_, "");
  EXPECT_TRUE(contains(message(), "is not a netCDF file: it is only 0 bytes long"));
  put_bytes(path_, "$MeshFormat\n2.2 0 8\n");
  EXPECT_TRUE(contains(message(), "is not a netCDF classic file"));
  int file = -1;
  ASSERT_EQ(nc_create(path_.c_str(), NC_CLOBBER, &file), NC_NOERR);
  ASSERT_EQ(nc_close(file), NC_NOERR);
  EXPECT_TRUE(contains(message(), "is a netCDF file, but not an Exodus results file"));
}

TEST_F(Results, DamagedFilesDoNotCrash) {
  const std::string bytes = expected(2);
  const std::size_t fixed = expected(0).size();
  for (std::size_t length = 0; length < bytes.size(); length += 11) {
    put_bytes(path_, bytes.substr(0, length));
    if (length < fixed) {
      EXPECT_TRUE(contains(error_of<Error>([&] { summarise_results(path_); }), path_)) << length;
    } else {
      EXPECT_EQ(summarise_results(path_).times.size(), length < expected(1).size() ? 0u : 1u);
    }
  }
  std::mt19937 random(13);
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k < 6; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    put_bytes(path_, damaged);
    try {
      summarise_results(path_);
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 300);
}

// Frame 1 of write_frame() above, in pieces, from the back, across the blocks of elements.
void put_pieces(ResultsWriter::Frame& frame) {
  const auto nodal = [](std::int64_t i) { return 1.0 / 3 + static_cast<double>(i); };
  for (std::int64_t i = 5; i >= 0; --i) {
    const double x = nodal(i), y = i == 2 ? std::numeric_limits<double>::quiet_NaN() : -x;
    frame.put_nodal(1, i, std::span(&y, 1));
    frame.put_nodal(0, i, std::span(&x, 1));
  }
  frame.put_element(0, 3, std::vector<double>{1, 1});
  frame.put_element(0, 0, std::vector<double>{0, 1, 1});
}

TEST_F(Results, AFrameInPiecesHasTheSameBytes) {
  ResultsWriter results = ResultsWriter::create(path_, plate());
  write_frame(results, 0);
  {
    ResultsWriter::Frame frame = results.begin_frame(0.1, std::vector{1.0, 1e-9});
    put_pieces(frame);
    EXPECT_EQ(results.frames(), 1);
    frame.finish();
  }
  EXPECT_EQ(results.frames(), 2);
  EXPECT_EQ(bytes_of(path_), expected(2));
}

TEST_F(Results, AFrameThatIsNotFinishedIsTakenBack) {
  ResultsWriter results = ResultsWriter::create(path_, plate());
  write_frame(results, 0);
  {
    ResultsWriter::Frame frame = results.begin_frame(0.1, std::vector{1.0, 1e-9});
    put_pieces(frame);
  }
  EXPECT_EQ(results.frames(), 1);
  EXPECT_EQ(bytes_of(path_), expected(1));
  write_frame(results, 1);
  EXPECT_EQ(bytes_of(path_), expected(2));
}

TEST_F(Results, AFrameWithWrongPiecesIsRefused) {
  ResultsWriter results = ResultsWriter::create(path_, plate());
  const std::vector<double> two(2), global{1.0, 1e-9};
  EXPECT_THROW(results.begin_frame(0, two).finish(), Error);  // nothing was put
  EXPECT_THROW(results.begin_frame(0, std::vector<double>(3)), Error);
  EXPECT_THROW(results.begin_frame(0, global).put_nodal(0, 5, two), Error);
  EXPECT_THROW(results.begin_frame(0, global).put_nodal(0, -1, two), Error);
  EXPECT_THROW(results.begin_frame(0, global).put_nodal(2, 0, two), Error);
  EXPECT_THROW(results.begin_frame(0, global).put_element(0, 4, two), Error);
  EXPECT_THROW(results.begin_frame(0, global).put_element(1, 0, two), Error);
  EXPECT_EQ(bytes_of(path_), expected(0));
}

}  // namespace
