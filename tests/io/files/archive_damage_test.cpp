// Damaged archives: every byte and every length of a small file, and files that are something else.
#include <gtest/gtest.h>
#include <netcdf.h>

#include <random>

#include "io/archive.hpp"
#include "io/error.hpp"
#include "io/netcdf_layout.hpp"
#include "sample_archive.hpp"
#include "scratch_folder.hpp"

namespace {

using namespace cleave::io;

// Empty if the file is refused with a message that names it, otherwise what went wrong.
std::string accepted(const std::string& path, void (*read)(const std::string&)) {
  try {
    read(path);
  } catch (const Error& error) {
    const std::string message = error.what();
    return message.starts_with(path) ? "" : "message without the file: " + message;
  }
  return "was read without an error";
}

void read_all(const std::string& path) { read_archive(path); }

class DamagedArchive : public testing::Test {
 protected:
  void SetUp() override {
    write_archive(path_, sample_archive());
    bytes_ = bytes_of(path_);
  }
  ScratchFolder folder_;
  std::string path_ = folder_.file("state.nc"), bytes_;
};

// One bit of every byte, each bit of the eight in turn; once all of them were tried (14 000, 11 s).
TEST_F(DamagedArchive, AFlippedBitInAnyByteIsFound) {
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    std::string damaged = bytes_;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
    put_bytes(path_, damaged);
    ASSERT_EQ(accepted(path_, i % 16 < 8 ? read_all : verify_archive), "") << "byte " << i;
  }
}

// Every bit of a byte, in an archive as large as a small checkpoint: dense in the header, sparse behind it.
TEST_F(DamagedArchive, EveryBitOfSampledBytesIsFound) {
  std::mt19937 random(3);
  Archive archive = sample_archive();
  for (int i = 0; i < 30; ++i) {
    std::vector<double> values(1 + random() % 3000);
    for (double& value : values) value = static_cast<double>(random());
    archive.arrays.push_back({"plate/field" + std::to_string(i), "m", "a field", 1, values});
  }
  write_archive(path_, archive);
  const std::string whole = bytes_of(path_);
  const auto header = static_cast<std::size_t>(read_netcdf_layout(path_).header_bytes);
  std::vector<std::size_t> places;
  for (std::size_t i = random() % 41; i < header; i += 1 + random() % 81) places.push_back(i);
  for (int i = 0; i < 100; ++i) places.push_back(header + random() % (whole.size() - header));
  for (const std::size_t place : places) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = whole;
      damaged[place] = static_cast<char>(damaged[place] ^ (1 << bit));
      put_bytes(path_, damaged);
      ASSERT_EQ(accepted(path_, verify_archive), "") << "byte " << place << ", bit " << bit;
    }
  }
}

TEST_F(DamagedArchive, EveryTruncationIsFound) {
  for (std::size_t length = 0; length < bytes_.size(); ++length) {
    put_bytes(path_, bytes_.substr(0, length));
    ASSERT_EQ(accepted(path_, read_all), "") << length;
    ASSERT_EQ(accepted(path_, [](const std::string& p) { read_archive_header(p); }), "") << length;
  }
}

TEST_F(DamagedArchive, BytesBehindTheEndAreFound) {
  for (const std::size_t extra : {1u, 8u, 4096u}) {
    put_bytes(path_, bytes_ + std::string(extra, '\0'));
    ASSERT_EQ(accepted(path_, read_all), "");
  }
}

TEST_F(DamagedArchive, SwappedAndRepeatedBlocksAreFound) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes_;
    const std::size_t length = 1 + random() % 64;
    const std::size_t from = random() % (bytes_.size() - length),
                      to = random() % (bytes_.size() - length);
    damaged.replace(to, length, bytes_, from, length);
    if (damaged == bytes_) continue;
    put_bytes(path_, damaged);
    ASSERT_EQ(accepted(path_, read_all), "") << length << " bytes from " << from << " to " << to;
  }
}

TEST_F(DamagedArchive, GarbageIsRefused) {
  std::mt19937 random(11);
  for (int i = 0; i < 300; ++i) {
    std::string garbage(random() % 2000, '\0');
    for (char& c : garbage) c = static_cast<char>(random());
    if (i % 2 == 0) garbage.replace(0, 4, std::string("CDF\x05", 4));
    put_bytes(path_, garbage);
    ASSERT_EQ(accepted(path_, read_all), "");
  }
}

TEST_F(DamagedArchive, TheMessageNamesTheArray) {
  const std::size_t last = bytes_.size() - 1;  // in "one", the last array
  bytes_[last] = static_cast<char>(bytes_[last] ^ 1);
  put_bytes(path_, bytes_);
  const std::string message = error_of<Error>([&] { read_archive(path_); });
  EXPECT_NE(message.find("array 'one' is damaged: its checksum is crc64:"), std::string::npos)
      << message;
  EXPECT_NO_THROW(read_archive_header(path_));  // the header is as it was
}

TEST_F(DamagedArchive, TheMessageSaysTruncated) {
  put_bytes(path_, bytes_.substr(0, bytes_.size() - 8));
  const std::string message = error_of<Error>([&] { read_archive(path_); });
  EXPECT_NE(message.find("is truncated: " + std::to_string(bytes_.size() - 8) +
                         " bytes, its header promises " + std::to_string(bytes_.size())),
            std::string::npos)
      << message;
}

TEST_F(DamagedArchive, OtherFilesAreRefused) {
  const std::string other = folder_.file("other.nc");
  for (const int mode : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
    int file = -1, dimension = -1, variable = -1;
    const std::vector<double> x(5);
    ASSERT_EQ(nc_create(other.c_str(), mode | NC_CLOBBER, &file), NC_NOERR);
    ASSERT_EQ(nc_def_dim(file, "n", 5, &dimension), NC_NOERR);
    ASSERT_EQ(nc_def_var(file, "x", NC_DOUBLE, 1, &dimension, &variable), NC_NOERR);
    ASSERT_EQ(nc_enddef(file), NC_NOERR);
    ASSERT_EQ(nc_put_var_double(file, variable, x.data()), NC_NOERR);
    ASSERT_EQ(nc_close(file), NC_NOERR);
    EXPECT_EQ(accepted(other, read_all), "") << mode;
  }
  EXPECT_EQ(accepted(folder_.file("absent.nc"), read_all), "");
  EXPECT_EQ(accepted(folder_.file(""), read_all), "");  // a folder
  EXPECT_EQ(accepted("/dev/zero", read_all), "");
}

TEST_F(DamagedArchive, AnAbsentFileIsNamed) {
  const std::string message = error_of<Error>([&] { read_archive(folder_.file("absent.nc")); });
  EXPECT_NE(
      message.find("absent.nc: cannot read the file: No such file or directory; check the name"),
      std::string::npos)
      << message;
}

}  // namespace
