#include "io/new_file.hpp"

#include <gtest/gtest.h>

#include "io/error.hpp"
#include "scratch_folder.hpp"

namespace {

using namespace cleave::io;

TEST(NewFile, ReplacesTheOldOneWhenCommitted) {
  const ScratchFolder folder;
  put_bytes(folder.file("a"), "old");
  {
    NewFile file(folder.file("a"));
    put_bytes(file.temporary_path(), "new");
    EXPECT_EQ(bytes_of(folder.file("a")), "old");
    file.commit();
  }
  EXPECT_EQ(bytes_of(folder.file("a")), "new");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(NewFile, LeavesNothingWithoutCommit) {
  const ScratchFolder folder;
  put_bytes(folder.file("a"), "old");
  {
    const NewFile file(folder.file("a"));
    put_bytes(file.temporary_path(), "new");
    EXPECT_EQ(folder.entries(), 2u);
  }
  EXPECT_EQ(bytes_of(folder.file("a")), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(NewFile, SaysWhatFailed) {
  const ScratchFolder folder;
  NewFile never_written(folder.file("a"));
  EXPECT_EQ(
      error_of<Error>([&] { never_written.commit(); }),
      folder.file("a") +
          ": cannot give the finished file its name: No such file or directory; check the name, "
          "and that its folder exists");
  EXPECT_NE(error_of<Error>([] { NewFile(""); }).find("without a name"), std::string::npos);
}

// /dev/full is a disk without any space.
TEST(NewFile, AppendingToAFullDiskIsAnError) {
  EXPECT_EQ(
      error_of<Error>([] { append_to_file("/dev/full", "text"); }),
      "/dev/full: cannot write to the file: No space left on device; free space on that disk or "
      "write to another one");
}

}  // namespace
