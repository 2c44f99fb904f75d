// The tables of the manual pages on Abaqus and LS-DYNA have the counts of the library.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "adapters/fortran_host.hpp"

namespace cleave::test {
namespace {

// The numbers of the rows that begin with the name of a law.
std::map<std::string, std::vector<std::size_t>> rows(const std::string& page) {
  std::ifstream file(CLEAVE_HOST_PAGES + page);
  std::map<std::string, std::vector<std::size_t>> found;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("| `", 0) != 0) continue;
    std::istringstream words(line.substr(3));
    std::string law, bar;
    std::getline(words, law, '`');
    for (std::size_t number; words >> bar >> number;) found[law].push_back(number);
  }
  return found;
}

TEST(HostPages, HaveTheCountsOfTheLaws) {
  auto abaqus = rows("/abaqus.md"), lsdyna = rows("/lsdyna.md");
  const auto all = laws(1);
  EXPECT_EQ(abaqus.size(), all.size());
  EXPECT_EQ(lsdyna.size(), all.size());
  std::size_t number = 41;
  for (const Law& law : all) {
    const std::size_t n = law.properties.size(), h = law.history;
    EXPECT_EQ(abaqus[law.name], (std::vector<std::size_t>{n, h, h + 1})) << law.name;
    EXPECT_EQ(lsdyna[law.name], (std::vector<std::size_t>{number++, n, n + 2, h, h + 1}))
        << law.name;
  }
}

}  // namespace
}  // namespace cleave::test
