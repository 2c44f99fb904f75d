// Disks that fail: every system call by which files are written, in turn, returns an error, writes less
// than asked, or writes a wrong bit. The functions below stand in for those of the C library, for the
// netCDF library too.
#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <vector>

#include "io/archive.hpp"
#include "io/error.hpp"
#include "io/record_table.hpp"
#include "io/results.hpp"
#include "sample_archive.hpp"
#include "scratch_folder.hpp"

namespace {

// half_then_error: a disk that fills up in the middle of a write, and has space again after one error.
enum class Fault { none, error, lasting_error, short_write, half_then_error, wrong_bit };

struct Disk {
  Fault fault = Fault::none;
  int error = ENOSPC;
  int at = 0;         // the call that fails, counted from 0
  std::string calls;  // what was called: a letter each

  bool second = false;  // the call after that one

  std::size_t percent = 50;  // where in the bytes written the wrong bit is

  bool is_error() const { return fault == Fault::error || fault == Fault::lasting_error; }

  bool strikes(char call) {
    if (fault == Fault::none) return false;
    const int number = static_cast<int>(calls.size());
    calls += call;
    if (number < at) return false;
    second = number > at;
    if (second && number == at + 1 && fault == Fault::half_then_error) return call == 'w';
    if (second && fault != Fault::lasting_error) return false;
    return call == 'w' || is_error();
  }
};

Disk disk;

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int failed() {
  errno = disk.error;
  return -1;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, std::size_t count) {
  static auto* const real_write = real<ssize_t(int, const void*, std::size_t)>("write");
  if (file <= STDERR_FILENO || !disk.strikes('w')) return real_write(file, bytes, count);
  if (disk.is_error()) return failed();
  if (disk.fault == Fault::half_then_error && disk.second) return failed();
  if (disk.fault != Fault::wrong_bit) return real_write(file, bytes, (count + 1) / 2);
  std::string damaged(static_cast<const char*>(bytes), count);
  const std::size_t place = (count - 1) * disk.percent / 100;
  damaged[place] = static_cast<char>(damaged[place] ^ 4);
  return real_write(file, damaged.data(), count);
}

int fsync(int file) {
  static auto* const real_fsync = real<int(int)>("fsync");
  return disk.strikes('s') ? failed() : real_fsync(file);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const real_rename = real<int(const char*, const char*)>("rename");
  return disk.strikes('r') ? failed() : real_rename(from, to);
}

int close(int file) {
  static auto* const real_close = real<int(int)>("close");
  const int status = real_close(file);
  return disk.strikes('c') ? failed() : status;
}

int truncate(const char* path, off_t size) noexcept {
  static auto* const real_truncate = real<int(const char*, off_t)>("truncate");
  return disk.strikes('t') ? failed() : real_truncate(path, size);
}
}

namespace {

using namespace cleave::io;

// Does `action` with the fault at call `at`; the text of its error, or "".
template <class Action>
std::string with_fault(Fault fault, int error, int at, Action&& action) {
  disk.fault = fault;
  disk.error = error;
  disk.at = at;
  disk.calls.clear();
  std::string message;
  try {
    action();
  } catch (const Error& caught) {
    message = caught.what();
  }
  disk.fault = Fault::none;
  return message;
}

Archive old_archive() {
  Archive archive;
  archive.arrays = {{"x", "m", "", 1, std::vector<double>{1, 2, 3}}};
  return archive;
}

struct Kind {
  Fault fault;
  int error;
  std::string message;
};

const std::vector<Kind> kKinds{{Fault::error, ENOSPC, "No space left on device; free space"},
                               {Fault::error, EIO, "Input/output error; the disk reports a fault"},
                               {Fault::error, EDQUOT, "Disk quota exceeded; your quota is used up"},
                               {Fault::lasting_error, ENOSPC, "No space left on device"},
                               {Fault::short_write, 0, ""},
                               {Fault::half_then_error, ENOSPC, ""},
                               {Fault::wrong_bit, 0, ""}};

TEST(FaultyDisk, TheStepsOfASafeWriteAreInOrder) {
  const ScratchFolder folder;
  with_fault(Fault::error, EIO, 1 << 30,
             [&] { write_archive(folder.file("a.nc"), sample_archive()); });
  std::string steps;
  for (const char call : disk.calls) {
    if (call != 'c' && (steps.empty() || steps.back() != call)) steps += call;
  }
  EXPECT_EQ(steps, "wsrs");  // write, flush the file, rename, flush the folder
}

// Either the old archive is there or the new one, whole; and the new one if no error was reported.
TEST(FaultyDisk, AnArchiveIsTheOldOrTheNewOne) {
  const ScratchFolder folder;
  const std::string path = folder.file("state.nc");
  write_archive(path, sample_archive());
  const std::string new_bytes = bytes_of(path);
  write_archive(path, old_archive());
  const std::string old_bytes = bytes_of(path);
  for (const Kind& kind : kKinds) {
    int reported = 0;
    for (int at = 0;; ++at) {
      put_bytes(path, old_bytes);
      const std::string message =
          with_fault(kind.fault, kind.error, at, [&] { write_archive(path, sample_archive()); });
      const std::string found = bytes_of(path);
      ASSERT_TRUE(found == old_bytes || found == new_bytes) << at;
      ASSERT_TRUE(!message.empty() || found == new_bytes) << at;
      ASSERT_EQ(folder.entries(), 1u) << at;
      if (!message.empty()) {
        ++reported;
        ASSERT_NE(message.find(kind.message), std::string::npos) << message;
      }
      if (at >= static_cast<int>(disk.calls.size())) break;
    }
    // A short write is made good; the others cannot be.
    EXPECT_EQ(reported > 0, kind.fault != Fault::short_write);
  }
}

// Header and data are several buffers long, so that a wrong bit in one is not written over with another.
TEST(FaultyDisk, AWrongBitAnywhereIsFound) {
  const ScratchFolder folder;
  const std::string path = folder.file("state.nc");
  Archive archive = sample_archive();
  archive.attributes.push_back({"long_deck", std::string(200000, 'x')});
  archive.arrays.push_back({"long", "m", "", 1, std::vector<double>(25000, 1.0)});
  int found = 0;
  for (const std::size_t percent : {0, 30, 60, 100}) {
    disk.percent = percent;
    for (int at = 0;; ++at) {
      write_archive(path, old_archive());
      const std::string message =
          with_fault(Fault::wrong_bit, 0, at, [&] { write_archive(path, archive); });
      const bool done = at >= static_cast<int>(disk.calls.size());
      if (message.empty()) {
        ASSERT_EQ(bits_of(read_archive(path).arrays.back().data),
                  bits_of(archive.arrays.back().data));
        ASSERT_EQ(read_archive(path).attributes.back(), archive.attributes.back()) << at;
      } else {
        ++found;
        ASSERT_EQ(read_archive(path).arrays.size(), 1u);
      }
      if (done) break;
    }
  }
  EXPECT_GT(found, 12);
}

const std::vector<Column> kColumns{{"step", "1", "", true}, {"energy", "J", "", false}};

void append(RecordTable& table, int from, int to) {
  for (int i = from; i < to; ++i) table.append(std::vector<double>{1.0 * i, i / 3.0});
}

// After an error the same call is repeated, and then the files are as if there had been none.
TEST(FaultyDisk, ATableLosesNoRecord) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.nc"), csv = folder.file("a.csv");
  const auto create = [&] { return RecordTable::create(path, csv, kColumns, {}); };
  {
    RecordTable table = create();
    append(table, 0, 300);
  }
  const std::string bytes = bytes_of(path), csv_bytes = bytes_of(csv);
  for (const Kind& kind : kKinds) {
    if (kind.fault == Fault::wrong_bit) continue;  // nothing verifies tables
    int reported = 0;
    for (int at = 0;; ++at) {
      RecordTable table = create();
      append(table, 0, 100);
      table.flush();
      append(table, 100, 300);
      const std::string message = with_fault(kind.fault, kind.error, at, [&] { table.sync(); });
      const bool done = at >= static_cast<int>(disk.calls.size());
      if (!message.empty()) ++reported;
      ASSERT_TRUE(message.empty() || message.find(kind.message) != std::string::npos) << message;
      ASSERT_NO_THROW(table.sync());
      ASSERT_TRUE(bytes_of(path) == bytes && bytes_of(csv) == csv_bytes) << at << ": " << message;
      const std::string reopening = with_fault(
          kind.fault, kind.error, at, [&] { RecordTable::reopen(path, csv, kColumns, 300); });
      ASSERT_NO_THROW(RecordTable::reopen(path, csv, kColumns, 300));
      ASSERT_TRUE(bytes_of(path) == bytes && bytes_of(csv) == csv_bytes) << at << ": " << reopening;
      if (done && at >= static_cast<int>(disk.calls.size())) break;
    }
    EXPECT_EQ(reported > 0, kind.fault != Fault::short_write);
  }
}

TEST(FaultyDisk, ResultsLoseOnlyTheFrame) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.exo");
  ResultLayout layout;
  layout.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  layout.point_ids = {1, 2, 3};
  layout.blocks = {{"plate", CellKind::triangle, {0, 1, 2}}};
  layout.nodal = {{"p", "Pa", ""}};
  layout.element = {{"status", "1", ""}};
  const auto write_frame = [](ResultsWriter& results, double time) {
    const std::vector<std::vector<double>> nodal{{time, 2, 3}}, element{{1}};
    results.write_frame(time, nodal, element, {});
  };
  ResultsWriter whole = ResultsWriter::create(path, layout);
  write_frame(whole, 0.5);
  const std::string one = bytes_of(path);
  write_frame(whole, 1);
  const std::string two = bytes_of(path);
  for (const Kind& kind : kKinds) {
    if (kind.fault == Fault::wrong_bit) continue;  // nothing verifies results
    int reported = 0;
    for (int at = 0;; ++at) {
      const std::string created =
          with_fault(kind.fault, kind.error, at, [&] { ResultsWriter::create(path, layout); });
      const bool done = at >= static_cast<int>(disk.calls.size());
      ASSERT_EQ(folder.entries(), 1u);
      ResultsWriter results = ResultsWriter::create(path, layout);
      write_frame(results, 0.5);
      const std::string message =
          with_fault(kind.fault, kind.error, at, [&] { write_frame(results, 1); });
      if (!message.empty()) {
        ++reported;
        // While the disk fails, the frame cannot be taken back either.
        ASSERT_TRUE(bytes_of(path) == one || kind.fault == Fault::lasting_error) << at;
        ASSERT_NO_THROW(write_frame(results, 1));
      }
      ASSERT_TRUE(bytes_of(path) == two) << at << ": " << message;
      if (done && at >= static_cast<int>(disk.calls.size())) break;
    }
    EXPECT_EQ(reported > 0, kind.fault != Fault::short_write);
  }
}

}  // namespace
