#include "io/netcdf_layout.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <array>
#include <random>

#include "io/error.hpp"
#include "scratch_folder.hpp"

namespace {

using namespace cleave::io;

// A file of mode `mode` with `records` records of the record variables whose types are given, beside
// fixed variables of sizes that need padding.
void make_file(const std::string& path, int mode, const std::vector<nc_type>& record_types,
               std::size_t records) {
  int file = -1;
  std::array<int, 3> dimensions{};
  std::vector<int> variables(record_types.size());
  int fixed = -1, text = -1;
  ASSERT_EQ(nc_create(path.c_str(), mode | NC_CLOBBER, &file), NC_NOERR);
  ASSERT_EQ(nc_put_att_text(file, NC_GLOBAL, "title", 5, "a set"), NC_NOERR);
  ASSERT_EQ(nc_def_dim(file, "record", NC_UNLIMITED, &dimensions[0]), NC_NOERR);
  ASSERT_EQ(nc_def_dim(file, "three", 3, &dimensions[1]), NC_NOERR);
  ASSERT_EQ(nc_def_dim(file, "five", 5, &dimensions[2]), NC_NOERR);
  ASSERT_EQ(nc_def_var(file, "fixed", NC_DOUBLE, 2, &dimensions[1], &fixed), NC_NOERR);
  ASSERT_EQ(nc_def_var(file, "text", NC_CHAR, 1, &dimensions[1], &text), NC_NOERR);
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const std::string name = "growing_" + std::to_string(v);
    ASSERT_EQ(nc_def_var(file, name.c_str(), record_types[v], 2, dimensions.data(), &variables[v]),
              NC_NOERR);
  }
  ASSERT_EQ(nc_enddef(file), NC_NOERR);
  const std::vector<double> values(15, 1.5);
  ASSERT_EQ(nc_put_var_double(file, fixed, values.data()), NC_NOERR);
  ASSERT_EQ(nc_put_var_text(file, text, "abc"), NC_NOERR);
  for (std::size_t r = 0; r < records; ++r) {
    const std::array<std::size_t, 2> start{r, 0}, count{1, 3};
    const std::vector<double> row(3, static_cast<double>(r + 1));
    for (const int variable : variables) {
      ASSERT_EQ(nc_put_vara_double(file, variable, start.data(), count.data(), row.data()),
                NC_NOERR);
    }
  }
  ASSERT_EQ(nc_close(file), NC_NOERR);
}

struct Kind {
  int mode, version;
  std::vector<nc_type> record_types;
  std::int64_t record_bytes;
};

// NC_SHORT: 3 values are 6 bytes, padded to 8 unless it is the only record variable.
const std::vector<Kind> kKinds{{0, 1, {NC_DOUBLE}, 24},
                               {0, 1, {NC_SHORT, NC_DOUBLE}, 32},
                               {NC_64BIT_OFFSET, 2, {NC_SHORT}, 6},
                               {NC_64BIT_OFFSET, 2, {NC_BYTE, NC_FLOAT, NC_INT}, 28},
                               {NC_64BIT_DATA, 5, {NC_INT64, NC_UINT}, 36},
                               {NC_64BIT_DATA, 5, {}, 0}};

TEST(NetcdfLayout, IsThatOfTheLibrary) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.nc");
  for (const Kind& kind : kKinds) {
    for (const std::size_t records : {0u, 1u, 3u}) {
      make_file(path, kind.mode, kind.record_types, records);
      const NetcdfLayout layout = read_netcdf_layout(path);
      const bool grows = !kind.record_types.empty();
      EXPECT_EQ(layout.version, kind.version);
      EXPECT_EQ(layout.found_records, grows ? static_cast<std::int64_t>(records) : 0);
      EXPECT_EQ(layout.record_bytes, kind.record_bytes);
      EXPECT_EQ(layout.variables.front().name, "fixed");
      EXPECT_EQ(layout.variables.front().bytes, 120);
      EXPECT_EQ(layout.variables.front().begin, layout.header_bytes);
      // The library pads the end to four bytes except after a lone record variable.
      EXPECT_EQ(layout.promised_bytes, static_cast<std::int64_t>(bytes_of(path).size()))
          << kind.mode << " with " << records;
    }
  }
}

TEST(NetcdfLayout, ShortenedFilesAreThoseThatNeverWereLonger) {
  const ScratchFolder folder;
  for (const Kind& kind : kKinds) {
    if (kind.record_types.empty()) continue;
    for (const std::size_t records : {0u, 2u, 3u}) {
      make_file(folder.file("long.nc"), kind.mode, kind.record_types, 3);
      make_file(folder.file("short.nc"), kind.mode, kind.record_types, records);
      truncate_records(folder.file("long.nc"), static_cast<std::int64_t>(records));
      EXPECT_EQ(bytes_of(folder.file("long.nc")), bytes_of(folder.file("short.nc")))
          << kind.mode << " to " << records;
    }
  }
}

// A kill between the two steps of truncate_records leaves the count written and the tail still there.
TEST(NetcdfLayout, ATailBehindTheLastRecordIsDropped) {
  const ScratchFolder folder;
  make_file(folder.file("a.nc"), NC_64BIT_DATA, {NC_DOUBLE}, 2);
  const std::string expected = bytes_of(folder.file("a.nc"));
  put_bytes(folder.file("a.nc"), expected + std::string(40, 'x'));
  truncate_records(folder.file("a.nc"), 2);
  EXPECT_EQ(bytes_of(folder.file("a.nc")), expected);
}

// A kill while a record is written: it is promised, but not there, or not all of it.
TEST(NetcdfLayout, AnIncompleteLastRecordIsDropped) {
  const ScratchFolder folder;
  make_file(folder.file("two.nc"), NC_64BIT_DATA, {NC_DOUBLE}, 2);
  make_file(folder.file("three.nc"), NC_64BIT_DATA, {NC_DOUBLE}, 3);
  const std::string two = bytes_of(folder.file("two.nc")),
                    three = bytes_of(folder.file("three.nc"));
  for (std::size_t length = two.size(); length < three.size(); ++length) {
    put_bytes(folder.file("a.nc"), three.substr(0, length));
    const NetcdfLayout layout = read_netcdf_layout(folder.file("a.nc"));
    EXPECT_EQ(layout.promised_records, 3);
    EXPECT_EQ(layout.found_records, 2);
    truncate_records(folder.file("a.nc"), 2);
    EXPECT_EQ(bytes_of(folder.file("a.nc")), two);
  }
}

TEST(NetcdfLayout, TooFewRecordsAreAnError) {
  const ScratchFolder folder;
  make_file(folder.file("a.nc"), NC_64BIT_DATA, {NC_DOUBLE}, 2);
  const std::string before = bytes_of(folder.file("a.nc"));
  const std::string message = error_of<Error>([&] { truncate_records(folder.file("a.nc"), 3); });
  EXPECT_NE(message.find("a.nc: has 2 records, 3 are needed to continue"), std::string::npos)
      << message;
  EXPECT_EQ(bytes_of(folder.file("a.nc")), before);
}

TEST(NetcdfLayout, FilesTruncatedBeforeTheLastRecordAreAnError) {
  const ScratchFolder folder;
  for (const Kind& kind : kKinds) {
    if (kind.record_types.empty()) continue;
    make_file(folder.file("a.nc"), kind.mode, kind.record_types, 2);
    const std::string bytes = bytes_of(folder.file("a.nc"));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      put_bytes(folder.file("b.nc"), bytes.substr(0, length));
      const std::string message =
          error_of<Error>([&] { truncate_records(folder.file("b.nc"), 2); });
      ASSERT_TRUE(message.starts_with(folder.file("b.nc") + ": ")) << length;
    }
  }
}

// Any answer or any message, but no crash (run with the sanitizers) and no endless loop.
TEST(NetcdfLayout, SurvivesDamage) {
  const ScratchFolder folder;
  std::mt19937 random(5);
  make_file(folder.file("a.nc"), NC_64BIT_DATA, {NC_INT64, NC_SHORT}, 2);
  const std::string bytes = bytes_of(folder.file("a.nc"));
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k < 4; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    put_bytes(folder.file("b.nc"), damaged);
    try {
      const NetcdfLayout layout = read_netcdf_layout(folder.file("b.nc"));
      ASSERT_LE(layout.found_records * layout.record_bytes,
                static_cast<std::int64_t>(bytes.size()));
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);  // measured: 1200 of 2000
}

}  // namespace
