#include "command/verify.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "command/checkpoint_text.hpp"
#include "deck/deck.hpp"
#include "io/archive.hpp"
#include "io/netcdf_layout.hpp"
#include "io/record_table.hpp"

namespace cleave::driver {
namespace {

namespace fs = std::filesystem;

class Verify : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = fs::path(::testing::TempDir()) / (std::string("verify_") + info->name());
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string checkpoint(std::int64_t step) const {
    io::Archive archive;
    archive.attributes = {{"content", "cleave checkpoint"},
                          {"format", std::int64_t{1}},
                          {"cleave_version", "0.0.7"},
                          {"step", step},
                          {"time", 0.5},
                          {"bodies", "plate\nrod\n"},
                          {"deck", "&run /"}};
    archive.arrays = {{"plate/a", "m", "a", 3, std::vector<double>(30, 1.0)},
                      {"plate/b", "m", "b", 1, std::vector<double>(10, 2.0)},
                      {"plate/point_ids", "1", "ids", 1, std::vector<std::int64_t>(10, 3)}};
    const std::string file = path("case." + std::to_string(step) + ".checkpoint.nc");
    io::write_archive(file, archive);
    return file;
  }
  static void flip(const std::string& file, std::int64_t offset) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(offset);
    const char byte = static_cast<char>(stream.get() ^ 4);
    stream.seekp(offset);
    stream.put(byte);
  }
  static std::int64_t begin_of(const std::string& file, const std::string& array) {
    for (const auto& variable : io::read_netcdf_layout(file).variables)
      if (variable.name == array) return variable.begin;
    return -1;
  }
  static ::testing::AssertionResult says(const std::string& text, const std::string& part) {
    if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "no \"" << part << "\" in: " << text;
  }

 private:
  fs::path directory_;
};

TEST_F(Verify, NamesEveryArrayThatFails) {
  const std::string file = checkpoint(5);
  EXPECT_TRUE(verify_file(file, {}).good);
  EXPECT_TRUE(says(verify_file(file, {}).text, "verified: the header and 3 arrays"));
  flip(file, begin_of(file, "plate:a") + 17);
  flip(file, begin_of(file, "plate:point_ids"));
  const Verification found = verify_file(file, {});
  EXPECT_FALSE(found.good);
  EXPECT_TRUE(says(found.text, "array 'plate/a' is damaged"));
  EXPECT_TRUE(says(found.text, "array 'plate/point_ids' is damaged"));
  EXPECT_FALSE(says(found.text, "array 'plate/b'"));
  flip(file, 40);
  EXPECT_FALSE(verify_file(file, {}).good);
}

TEST_F(Verify, JudgesAFileWithoutItsHeaderByItsName) {
  const std::string file = checkpoint(5);
  flip(file, 0);
  EXPECT_FALSE(verify_file(file, {}).good);
  EXPECT_TRUE(says(verify_file(file, {}).text, ": broken\n"));
}

TEST_F(Verify, ListsADirectoryNewestFirst) {
  checkpoint(5);
  const std::string broken = checkpoint(20);
  checkpoint(100);
  flip(broken, begin_of(broken, "plate:b"));
  const Verification found = verify_directory(path(""), {});
  EXPECT_FALSE(found.good);
  EXPECT_TRUE(says(found.text, "3 checkpoints, newest first"));
  const auto newest = found.text.find("case.100."), middle = found.text.find("case.20."),
             oldest = found.text.find("case.5.");
  EXPECT_LT(newest, middle);
  EXPECT_LT(middle, oldest);
  EXPECT_TRUE(says(found.text.substr(middle, oldest - middle), "broken: "));
  EXPECT_TRUE(
      says(found.text.substr(newest, middle - newest), "verified, but it has checkpoint format 1"));
  fs::remove(broken);
  EXPECT_TRUE(verify_directory(path(""), {}).good);
  fs::create_directories(path("empty"));
  EXPECT_THROW(verify_directory(path("empty"), {}), DeckError);
}

TEST_F(Verify, TablesAreMeasuredAgainstTheirHeader) {
  const std::string file = path("case.history.nc");
  {
    io::RecordTable table = io::RecordTable::create(file, "", {{"time", "s", "time", false}}, {});
    for (int i = 0; i < 20; ++i) table.append(std::vector<double>{1.0 * i});
  }
  EXPECT_TRUE(verify_file(file, {}).good);
  EXPECT_TRUE(says(verify_file(file, {}).text, "complete: 20 records"));
  EXPECT_TRUE(says(verify_file(file, {}).text, "carry no checksums"));
  fs::resize_file(file, fs::file_size(file) - 8);
  EXPECT_FALSE(verify_file(file, {}).good);
  EXPECT_TRUE(says(verify_file(file, {}).text, "its header promises"));
}

TEST_F(Verify, DescribesAnOldCheckpointAndItsDeck) {
  const std::string file = checkpoint(5);
  const std::string text = checkpoint_text(file, io::read_archive_header(file));
  for (const char* part :
       {"after step 5 of unknown, time 0.5", "body 'plate': dimension unknown, 10 particles",
        "body 'rod'", "cleave 0.0.7, format 1", "this version cannot continue it"})
    EXPECT_TRUE(says(text, part));
  EXPECT_EQ(checkpoint_deck(file), "&run /\n");
}

}  // namespace
}  // namespace cleave::driver
