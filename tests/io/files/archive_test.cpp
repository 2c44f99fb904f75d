#include "io/archive.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file_size_limit.hpp"
#include "io/checksum.hpp"
#include "io/error.hpp"
#include "sample_archive.hpp"
#include "scratch_folder.hpp"

namespace {

using namespace cleave::io;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void expect_same(const Archive& found, const Archive& expected) {
  ASSERT_EQ(found.attributes.size(), expected.attributes.size());
  for (std::size_t i = 0; i < expected.attributes.size(); ++i) {
    EXPECT_EQ(found.attributes[i].first, expected.attributes[i].first);
    const AttributeValue &a = found.attributes[i].second, &b = expected.attributes[i].second;
    ASSERT_EQ(a.index(), b.index());
    if (const double* real = std::get_if<double>(&a)) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(*real),
                std::bit_cast<std::uint64_t>(std::get<double>(b)));
    } else {
      EXPECT_EQ(a, b);
    }
  }
  ASSERT_EQ(found.arrays.size(), expected.arrays.size());
  for (std::size_t i = 0; i < expected.arrays.size(); ++i) {
    const NamedArray &a = found.arrays[i], &b = expected.arrays[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.units, b.units);
    EXPECT_EQ(a.description, b.description);
    EXPECT_EQ(a.components, b.components);
    EXPECT_EQ(a.data.index(), b.data.index()) << b.name;
    EXPECT_EQ(bits_of(a.data), bits_of(b.data)) << b.name;
  }
}

TEST(Archive, ReadsBackWhatWasWritten) {
  const ScratchFolder folder;
  const std::string path = folder.file("state.nc");
  write_archive(path, sample_archive());
  expect_same(read_archive(path), sample_archive());
  EXPECT_NO_THROW(verify_archive(path));
  EXPECT_EQ(folder.entries(), 1u);  // no temporary file is left
}

TEST(Archive, MayBeEmpty) {
  const ScratchFolder folder;
  write_archive(folder.file("empty.nc"), {});
  expect_same(read_archive(folder.file("empty.nc")), {});
  Archive only_empty;
  only_empty.arrays.push_back({"none", "m", "nothing", 3, std::vector<double>{}});
  write_archive(folder.file("none.nc"), only_empty);
  expect_same(read_archive(folder.file("none.nc")), only_empty);
}

// More than one block of the reader, with a number of components that does not divide a block.
TEST(Archive, HoldsLongArrays) {
  const ScratchFolder folder;
  Archive archive;
  std::vector<double> values(7 * 60001);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.1 * static_cast<double>(i);
  archive.arrays.push_back({"long", "1", "", 7, values});
  archive.arrays.push_back(
      {"wide", "1", "one row, longer than a block", 300000, std::vector<std::int64_t>(300000, 7)});
  write_archive(folder.file("long.nc"), archive);
  expect_same(read_archive(folder.file("long.nc")), archive);
  EXPECT_NO_THROW(verify_archive(folder.file("long.nc")));
}

TEST(Archive, SameContentsGiveTheSameBytes) {
  const ScratchFolder folder;
  write_archive(folder.file("a.nc"), sample_archive());
  write_archive(folder.file("b.nc"), read_archive(folder.file("a.nc")));
  EXPECT_EQ(bytes_of(folder.file("a.nc")), bytes_of(folder.file("b.nc")));
}

TEST(Archive, HeaderTellsNamesUnitsAndSizes) {
  const ScratchFolder folder;
  const std::string path = folder.file("state.nc");
  const Archive archive = sample_archive();
  write_archive(path, archive);
  const ArchiveHeader header = read_archive_header(path);
  ASSERT_EQ(header.arrays.size(), archive.arrays.size());
  EXPECT_EQ(header.attributes.size(), archive.attributes.size());
  EXPECT_EQ(std::get<double>(*header.find_attribute("time")), 0.1);
  EXPECT_EQ(header.find_attribute("absent"), nullptr);
  const ArrayInfo* bonds = header.find_array("plate/bonds");
  ASSERT_NE(bonds, nullptr);
  EXPECT_TRUE(bonds->is_integer);
  EXPECT_EQ(bonds->components, 2);
  EXPECT_EQ(bonds->size, 6);
  EXPECT_EQ(bonds->description, "numbers of the pair");
  EXPECT_EQ(bonds->checksum,
            crc64(std::span(std::get<1>(archive.find_array("plate/bonds")->data))));
  EXPECT_EQ(header.find_array("none")->size, 0);
  EXPECT_EQ(header.find_array("none")->components, 3);
  EXPECT_EQ(header.find_array("absent"), nullptr);
}

TEST(Archive, RefusesWhatItCouldNotReadBack) {
  const ScratchFolder folder;
  const auto message = [&](const Archive& archive) {
    return error_of<Error>([&] { write_archive(folder.file("bad.nc"), archive); });
  };
  Archive archive;
  archive.arrays = {{"x", "m", "", 3, std::vector<double>(4)}};
  EXPECT_TRUE(
      contains(message(archive), "'x' has 4 values, which is not a multiple of its 3 components"));
  archive.arrays = {{"x", "m", "", 0, std::vector<double>(4)}};
  EXPECT_TRUE(contains(message(archive), "its 0 components"));
  archive.arrays = {{"x", "m", "", 1, std::vector<double>(1)},
                    {"x", "m", "", 1, std::vector<double>(1)}};
  EXPECT_TRUE(contains(message(archive), "array 'x' occurs twice"));
  archive.arrays = {{"header_checksum", "m", "", 1, std::vector<double>(1)}};
  EXPECT_TRUE(contains(message(archive), "reserved"));
  for (const std::string& name : {std::string(), std::string("a b"), std::string("a:b"),
                                  std::string(".a"), std::string("ä"), std::string(256, 'a')}) {
    archive.arrays = {{name, "m", "", 1, std::vector<double>(1)}};
    EXPECT_TRUE(contains(message(archive), "has a name that cannot be stored; allowed are"))
        << name;
  }
  archive.arrays.clear();
  archive.attributes = {{"a/b", 1.0}};
  EXPECT_TRUE(contains(message(archive), "attribute 'a/b' has a name that cannot be stored"));
  archive.attributes = {{"archive_format", 1.0}};
  EXPECT_TRUE(contains(message(archive), "reserved"));
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(Archive, SaysWhyItCannotBeWritten) {
  const ScratchFolder folder;
  const auto message = [&](const std::string& path) {
    return error_of<Error>([&] { write_archive(path, sample_archive()); });
  };
  const std::string absent = folder.file("absent/state.nc");
  EXPECT_TRUE(contains(message(absent), absent));
  EXPECT_TRUE(contains(message(absent), "cannot create the file: No such file or directory"));
  put_bytes(folder.file("file"), "text");
  EXPECT_TRUE(contains(message(folder.file("file/state.nc")), "Not a directory"));
  std::filesystem::create_directory(folder.file("sub"));
  EXPECT_TRUE(contains(message(folder.file("sub")), "it is a folder; choose another name"));
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_TRUE(
      contains(message(folder.file("pipe")), "it is not a regular file; choose another name"));
}

TEST(Archive, SaysThatAFolderIsReadOnly) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.file("sub"));
  std::filesystem::permissions(
      folder.file("sub"), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const std::string message =
      error_of<Error>([&] { write_archive(folder.file("sub/state.nc"), sample_archive()); });
  EXPECT_TRUE(contains(message, "Permission denied; check the permissions")) << message;
  std::filesystem::permissions(folder.file("sub"), std::filesystem::perms::owner_all);
}

// Full after so many bytes, for all sizes of the disk in steps of 13 bytes: the old file stays, nothing else is left behind.
TEST(Archive, AFullDiskLeavesTheOldFile) {
  const ScratchFolder folder;
  const std::string path = folder.file("state.nc");
  Archive old_archive;
  old_archive.arrays = {{"x", "m", "", 1, std::vector<double>{1, 2, 3}}};
  write_archive(folder.file("full.nc"), sample_archive());
  const std::size_t size = bytes_of(folder.file("full.nc")).size();
  write_archive(path, old_archive);
  const std::string old_bytes = bytes_of(path);
  for (std::size_t limit = 0; limit < size; limit += 13) {
    std::string message;
    {
      const FileSizeLimit full(limit);
      message = error_of<Error>([&] { write_archive(path, sample_archive()); });
    }
    ASSERT_TRUE(contains(message, path) && contains(message, "File too large"))
        << limit << ": " << message;
    ASSERT_EQ(bytes_of(path), old_bytes);
    ASSERT_EQ(folder.entries(), 2u);
  }
  const FileSizeLimit just_enough(size);
  EXPECT_NO_THROW(write_archive(path, sample_archive()));
}

TEST(Archive, ReplacesWhatAKilledRunLeft) {
  const ScratchFolder folder;
  put_bytes(folder.file("state.nc.part"), std::string(100000, 'x'));
  write_archive(folder.file("state.nc"), sample_archive());
  expect_same(read_archive(folder.file("state.nc")), sample_archive());
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Archive, FollowsASymbolicLink) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.file("disk"));
  std::filesystem::create_symlink(folder.file("disk/real.nc"), folder.file("state.nc"));
  for (int i = 0; i < 2; ++i) {  // the link leads nowhere at first, then to a file
    write_archive(folder.file("state.nc"), sample_archive());
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("state.nc")));
    expect_same(read_archive(folder.file("disk/real.nc")), sample_archive());
  }
}

// An array of several blocks, read in pieces, of which none is kept.
TEST(ArchiveSource, WritesTheBytesOfAnArchiveInMemory) {
  ScratchFolder folder;
  constexpr std::int64_t kRows = 100001;  // of 3 values: more than two blocks
  const auto value = [](std::int64_t i) { return static_cast<double>(i) / 7; };
  Archive whole;
  whole.attributes = {{"step", std::int64_t{5}}};
  std::vector<double> reals;
  std::vector<std::int64_t> integers;
  for (std::int64_t i = 0; i < 3 * kRows; ++i) reals.push_back(value(i));
  for (std::int64_t i = 0; i < kRows; ++i) integers.push_back(-i);
  whole.arrays = {{"x", "m", "positions", 3, reals},
                  {"none", "m", "", 2, std::vector<double>{}},
                  {"marks", "1", "", 1, integers}};
  write_archive(folder.file("whole.nc"), whole);

  std::int64_t next = 0, largest = 0;
  ArchiveSource source;
  source.attributes = whole.attributes;
  source.arrays = {
      {"x", "m", "positions", 3, 3 * kRows,
       ReadValues<double>([&](std::int64_t first, std::span<double> values) {
         EXPECT_EQ(first, next);  // every value is asked for once
         EXPECT_EQ(std::ssize(values) % 3, 0);
         next += std::ssize(values);
         largest = std::max<std::int64_t>(largest, std::ssize(values));
         for (std::size_t k = 0; k < values.size(); ++k)
           values[k] = value(first + static_cast<std::int64_t>(k));
       })},
      {"none", "m", "", 2, 0, ReadValues<double>([](std::int64_t, std::span<double>) {
         ADD_FAILURE() << "there is nothing to read";
       })},
      {"marks", "1", "", 1, kRows,
       ReadValues<std::int64_t>([&](std::int64_t first, std::span<std::int64_t> values) {
         std::copy_n(integers.begin() + first, values.size(), values.begin());
       })}};
  write_archive_in_blocks(folder.file("blocks.nc"), source);
  EXPECT_EQ(next, 3 * kRows);
  EXPECT_LT(largest, 3 * kRows / 2);
  EXPECT_EQ(bytes_of(folder.file("blocks.nc")), bytes_of(folder.file("whole.nc")));
}

TEST(ArchiveSource, ThatFailsLeavesTheOldFile) {
  ScratchFolder folder;
  const std::string path = folder.file("a.nc");
  write_archive(path, sample_archive());
  const std::string before = bytes_of(path);
  ArchiveSource source;
  source.arrays = {{"x", "m", "", 1, 10, ReadValues<double>([](std::int64_t, std::span<double>) {
                      throw std::runtime_error("no such field");
                    })}};
  EXPECT_THROW(write_archive_in_blocks(path, source), std::runtime_error);
  EXPECT_EQ(bytes_of(path), before);
  EXPECT_NE(::access((path + ".part").c_str(), F_OK), 0);
}

TEST(ReadArchiveArray, GivesOneArrayAndVerifiesIt) {
  ScratchFolder folder;
  const std::string path = folder.file("a.nc");
  const Archive archive = sample_archive();
  write_archive(path, archive);
  for (const NamedArray& array : archive.arrays) {
    const NamedArray found = read_archive_array(path, array.name);
    EXPECT_EQ(found.components, array.components);
    EXPECT_EQ(bits_of(found.data), bits_of(array.data)) << array.name;
  }
  EXPECT_THROW(read_archive_array(path, "plate/y"), Error);
  std::string bytes = bytes_of(path);
  bytes[bytes.size() - 1] =
      static_cast<char>(bytes[bytes.size() - 1] ^ 1);  // the last value of "one"
  put_bytes(path, bytes);
  EXPECT_THROW(read_archive_array(path, "one"), Error);
  EXPECT_NO_THROW(read_archive_array(path, "plate/x"));
}

}  // namespace
