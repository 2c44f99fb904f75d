#include "io/record_table.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>

#include "file_size_limit.hpp"
#include "io/error.hpp"
#include "io/netcdf_layout.hpp"
#include "killed_child.hpp"
#include "scratch_folder.hpp"

namespace {

using namespace cleave::io;

const std::vector<Column> kColumns{{"step", "1", "number of the step", true},
                                   {"time", "s", "time at its end", false},
                                   {"energy", "J", "kinetic energy", false}};

// Record i: nothing that is exact in a few digits.
std::vector<double> record(std::int64_t i) {
  const auto x = static_cast<double>(i);
  return {x - 3, x / 7, std::sin(x) * std::pow(10.0, static_cast<double>(i % 600 - 300))};
}

std::vector<double> read_column(const std::string& path, int variable) {
  int file = -1;
  EXPECT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file), NC_NOERR);
  std::size_t records = 0;
  EXPECT_EQ(nc_inq_dimlen(file, 0, &records), NC_NOERR);
  std::vector<double> values(records);
  EXPECT_EQ(nc_get_var_double(file, variable, values.data()), NC_NOERR);
  EXPECT_EQ(nc_close(file), NC_NOERR);
  return values;
}

class Table : public testing::Test {
 protected:
  RecordTable create() { return RecordTable::create(path_, csv_, kColumns, {{"units", "SI"}}); }
  RecordTable reopen(std::int64_t records) {
    return RecordTable::reopen(path_, csv_, kColumns, records);
  }
  static void append(RecordTable& table, std::int64_t from, std::int64_t to) {
    for (std::int64_t i = from; i < to; ++i) table.append(record(i));
  }
  // The two files of a table with `records` records that was written at once.
  std::pair<std::string, std::string> expected(std::int64_t records) {
    {
      auto table = RecordTable::create(folder_.file("expected.nc"), folder_.file("expected.csv"),
                                       kColumns, {{"units", "SI"}});
      append(table, 0, records);
    }
    return {bytes_of(folder_.file("expected.nc")), bytes_of(folder_.file("expected.csv"))};
  }
  std::pair<std::string, std::string> found() const { return {bytes_of(path_), bytes_of(csv_)}; }

  ScratchFolder folder_;
  std::string path_ = folder_.file("history.nc"), csv_ = folder_.file("history.csv");
};

TEST_F(Table, HoldsWhatWasAppended) {
  constexpr std::int64_t kRecords = 10000;  // several flushes by itself
  {
    RecordTable table = create();
    append(table, 0, kRecords);
    EXPECT_EQ(table.records(), kRecords);
  }
  for (int c = 0; c < 3; ++c) {
    const std::vector<double> values = read_column(path_, c);
    ASSERT_EQ(values.size(), static_cast<std::size_t>(kRecords));
    for (std::int64_t i = 0; i < kRecords; ++i) {
      ASSERT_EQ(values[static_cast<std::size_t>(i)], record(i)[static_cast<std::size_t>(c)]);
    }
  }
}

TEST_F(Table, CsvIsPlainAndReadsBackExactly) {
  using Limits = std::numeric_limits<double>;
  RecordTable table = create();
  table.append(std::vector{1e15, 0.1, 1e300});
  table.append(std::vector{-9007199254740992.0, Limits::quiet_NaN(), -Limits::infinity()});
  table.append(std::vector{0.0, -0.0, 5e-324});
  table.append(std::vector{2.0, std::copysign(Limits::quiet_NaN(), -1.0), Limits::infinity()});
  table.flush();
  EXPECT_EQ(
      bytes_of(csv_),
      "step [1],time [s],energy "
      "[J]\n1000000000000000,0.1,1e+300\n-9007199254740992,nan,-inf\n0,-0,5e-324\n2,nan,inf\n");
  const std::vector<double> times = read_column(path_, 1);
  EXPECT_TRUE(std::isnan(times[1]));
  EXPECT_TRUE(std::signbit(times[2]));
}

TEST_F(Table, CsvQuotesNamesThatNeedIt) {
  const std::vector<Column> columns{{"a", "m,s", "", false}, {"b", "\"", "", false}};
  const RecordTable table = RecordTable::create(path_, csv_, columns, {});
  EXPECT_EQ(bytes_of(csv_), "\"a [m,s]\",\"b [\"\"]\"\n");
}

TEST_F(Table, WorksWithoutCsv) {
  RecordTable table = RecordTable::create(path_, "", kColumns, {});
  append(table, 0, 3);
  table.sync();
  EXPECT_EQ(folder_.entries(), 1u);
  table = RecordTable::reopen(path_, "", kColumns, 2);
  append(table, 2, 5);
  table.flush();
  EXPECT_EQ(read_column(path_, 0), (std::vector<double>{-3, -2, -1, 0, 1}));
  EXPECT_EQ(folder_.entries(), 1u);
}

TEST_F(Table, MayStayEmpty) {
  { const RecordTable table = create(); }
  EXPECT_EQ(read_column(path_, 0).size(), 0u);
  EXPECT_EQ(bytes_of(csv_), "step [1],time [s],energy [J]\n");
  EXPECT_EQ(reopen(0).records(), 0);
}

TEST_F(Table, RecordsAreVisibleAfterFlushAndNotBefore) {
  RecordTable table = create();
  append(table, 0, 5);
  EXPECT_EQ(read_column(path_, 0).size(), 0u);
  table.flush();
  EXPECT_TRUE(found() == expected(5));
}

TEST_F(Table, FlushesItselfNowAndThen) {
  RecordTable table = create();
  append(table, 0, 4095);
  EXPECT_EQ(read_column(path_, 0).size(), 0u);
  append(table, 4095, 4100);
  EXPECT_EQ(read_column(path_, 0).size(), 4096u);
}

TEST_F(Table, ContinuesAsIfItHadNeverBeenLonger) {
  for (const std::int64_t kept : {0, 1, 4096, 5000, 9000}) {
    {
      RecordTable table = create();
      append(table, 0, 9000);
    }
    {
      RecordTable table = reopen(kept);
      EXPECT_EQ(table.records(), kept);
      EXPECT_TRUE(found() == expected(kept)) << kept;
      append(table, kept, 9100);
    }
    EXPECT_TRUE(found() == expected(9100)) << kept;
  }
}

TEST_F(Table, ReopeningRepairsTheCsv) {
  {
    RecordTable table = create();
    append(table, 0, 20);
  }
  for (const std::string& damaged : {std::string("step"), std::string(), std::string(5000, '\n')}) {
    put_bytes(csv_, damaged);
    { const RecordTable table = reopen(20); }
    EXPECT_TRUE(found() == expected(20));
  }
  std::filesystem::remove(csv_);
  { const RecordTable table = reopen(20); }
  EXPECT_TRUE(found() == expected(20));
}

TEST_F(Table, ReopeningAnotherTableIsAnError) {
  {
    RecordTable table = create();
    append(table, 0, 4);
  }
  const auto before = found();
  const auto message = [&](std::vector<Column> columns, std::int64_t records) {
    return error_of<Error>([&] { RecordTable::reopen(path_, csv_, std::move(columns), records); });
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(contains(message(kColumns, 5), "has 4 records, 5 are needed to continue"));
  EXPECT_TRUE(contains(message({kColumns[0]}, 4), "has 3 columns, this run has 1"));
  std::vector<Column> columns = kColumns;
  columns[2].units = "kJ";
  EXPECT_TRUE(
      contains(message(columns, 4),
               "column 3 is 'energy [J]', this run has 'energy [kJ]'; continue with the deck"));
  columns = kColumns;
  columns[0].is_integer = false;
  EXPECT_TRUE(contains(message(columns, 4), "column 1 is"));
  EXPECT_TRUE(found() == before);
  put_bytes(path_, bytes_of(path_).substr(0, bytes_of(path_).size() - 1));
  EXPECT_TRUE(contains(message(kColumns, 4), "has 3 records, 4 are needed"));
  put_bytes(path_, bytes_of(path_).substr(0, 100));
  EXPECT_TRUE(contains(message(kColumns, 0), "the header ends early"));
  std::filesystem::remove(path_);
  EXPECT_TRUE(contains(message(kColumns, 4), "No such file or directory"));
}

TEST_F(Table, RefusesRecordsThatDoNotFit) {
  RecordTable table = create();
  for (const double bad : {0.5, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    const std::string message = error_of<Error>([&] { table.append(std::vector{bad, 0.0, 0.0}); });
    EXPECT_NE(message.find("column 'step' holds integers up to 2^53"), std::string::npos)
        << message;
  }
  const std::string message = error_of<Error>([&] { table.append(std::vector{1.0}); });
  EXPECT_NE(message.find("a record has 1 values, the table has 3 columns"), std::string::npos)
      << message;
  EXPECT_EQ(table.records(), 0);
}

TEST_F(Table, RefusesColumnsThatCannotBe) {
  const auto message = [&](std::vector<Column> columns) {
    return error_of<Error>([&] { RecordTable::create(path_, csv_, std::move(columns), {}); });
  };
  EXPECT_NE(message({}).find("at least one column"), std::string::npos);
  EXPECT_NE(message({kColumns[0], kColumns[0]}).find("two columns have the name 'step'"),
            std::string::npos);
  EXPECT_NE(message({{"a/b", "", "", false}}).find("define the column 'a/b'"), std::string::npos);
  EXPECT_EQ(folder_.entries(), 0u);
}

// The disk is full during a flush; then there is space again.
TEST_F(Table, AFullDiskLosesNothing) {
  const auto [netcdf, csv] = expected(500);
  for (std::size_t limit = 500; limit < std::max(netcdf.size(), csv.size()); limit += 997) {
    RecordTable table = create();
    append(table, 0, 5);
    table.flush();
    append(table, 5, 500);
    {
      const FileSizeLimit full(limit);
      const std::string message = error_of<Error>([&] { table.flush(); });
      ASSERT_NE(message.find("File too large"), std::string::npos) << message;
    }
    ASSERT_TRUE(found() == expected(5)) << limit;
    EXPECT_EQ(table.records(), 500);
    table.flush();
    ASSERT_TRUE(found() == std::make_pair(netcdf, csv)) << limit;
  }
}

TEST_F(Table, AKillLosesNoFlushedRecord) {
  std::mt19937 random(3);
  for (int round = 0; round < 12; ++round) {
    constexpr std::int64_t kStep = 7, kSteps = 200;
    const auto work = [&](auto report) {
      RecordTable table = create();
      for (std::int64_t i = 0; i < kSteps; ++i) {
        append(table, i * kStep, (i + 1) * kStep);
        table.flush();
        report();
      }
    };
    const std::int64_t sure = kStep * steps_before_kill(work, 1 + round * 4, random() % 2000);
    {
      RecordTable table = reopen(sure);
      ASSERT_TRUE(found() == expected(sure)) << round;
      append(table, sure, kStep * kSteps);
    }
    ASSERT_TRUE(found() == expected(kStep * kSteps)) << round;
  }
}

}  // namespace
