// The last message: copied, cut, terminated, full length, one per thread.
#include <cstring>
#include <thread>

#include "support/model.hpp"

namespace cleave::test {
namespace {

TEST(Messages, AreCutTerminatedAndTellTheirFullLength) {
  int32_t value = 0;
  ASSERT_EQ(cleave_table_find(CLEAVE_TABLE_MATERIAL, "rubber", &value), CLEAVE_UNKNOWN_NAME);
  const std::string full = last_message();
  EXPECT_EQ(full.rfind("cleave_table_find: ", 0), 0u) << full;  // which call
  EXPECT_NE(full.find("'rubber'"), std::string::npos) << full;  // what was given
  EXPECT_NE(full.find("svk"), std::string::npos) << full;       // what is known
  for (const std::size_t capacity :
       {std::size_t{1}, std::size_t{7}, full.size(), full.size() + 1}) {
    std::vector<char> text(capacity + 4, '#');
    int64_t length = 0;
    ok(cleave_last_message(text.data(), static_cast<int64_t>(capacity), &length));
    EXPECT_EQ(length, static_cast<int64_t>(full.size()));
    const std::size_t kept = std::min(capacity - 1, full.size());
    EXPECT_EQ(std::string(text.data()), full.substr(0, kept));
    for (std::size_t k = capacity; k < text.size(); ++k) EXPECT_EQ(text[k], '#');
  }
}

TEST(Messages, WithoutABufferTellTheLengthOnly) {
  cleave_table_find(CLEAVE_TABLE_MATERIAL, "rubber", nullptr);
  int64_t length = 0;
  EXPECT_EQ(cleave_last_message(nullptr, 100, &length), CLEAVE_NULL_ARGUMENT);
  EXPECT_GT(length, 0);
  char c = '#';
  EXPECT_EQ(cleave_last_message(&c, 0, nullptr), CLEAVE_BAD_ARGUMENT);
  EXPECT_EQ(c, '#');
}

TEST(Messages, LongNamesAreCutNotOverrun) {
  const std::string name(10000, 'x');
  int32_t value = 0;
  ASSERT_EQ(cleave_table_find(CLEAVE_TABLE_MATERIAL, name.c_str(), &value), CLEAVE_UNKNOWN_NAME);
  std::vector<char> text(20000, '#');
  int64_t length = 0;
  ok(cleave_last_message(text.data(), 20000, &length));
  EXPECT_EQ(static_cast<int64_t>(std::strlen(text.data())), length);
  EXPECT_GT(length, 1000);
}

TEST(Messages, BelongToTheThreadThatMadeTheMistake) {
  cleave_table_find(CLEAVE_TABLE_MATERIAL, "mine", nullptr);
  std::string others;
  std::thread([&] {
    int64_t length = -1;
    char text[8] = "#";
    cleave_last_message(text, 8, &length);
    EXPECT_EQ(length, 0);
    EXPECT_STREQ(text, "");
    cleave_table_find(CLEAVE_TABLE_MATERIAL, "theirs", nullptr);
    others = last_message();
  }).join();
  EXPECT_NE(others.find("theirs"), std::string::npos);
  EXPECT_NE(last_message().find("mine"), std::string::npos);
}

TEST(Messages, StatusTextsComeFromTheTable) {
  EXPECT_STREQ(cleave_status_text(CLEAVE_OK), "no error");
  EXPECT_STREQ(cleave_status_text(CLEAVE_BAD_RANGE),
               "an index range does not lie inside the array");
  EXPECT_STREQ(cleave_status_text(-5), "unknown status");
  EXPECT_STREQ(cleave_version(), CLEAVE_VERSION);
}

}  // namespace
}  // namespace cleave::test
