// What the tests of runs share: a directory of their own, decks on small lattices, histories.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "run/run.hpp"
#include "scene/geometry.hpp"

namespace cleave::driver::testing {

// A fresh directory named after the test; removed at the end.
class RunDirectory : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    directory = std::filesystem::temp_directory_path() /
                ("cleave_" + std::string(info->test_suite_name()) + "_" + info->name() + "_" +
                 std::to_string(getpid()));
    std::filesystem::remove_all(directory);
    std::filesystem::create_directories(directory);
  }
  void TearDown() override { std::filesystem::remove_all(directory); }

  std::string path(const std::string& name) const { return (directory / name).string(); }

  // Runs a deck whose files are called "case"; `run` are keys of &run without name and directory.
  int run(const std::string& keys, const std::string& groups,
          const std::string& subdirectory = "") {
    return run_deck(deck(keys, groups, subdirectory), quiet);
  }
  Deck deck(const std::string& keys, const std::string& groups,
            const std::string& subdirectory = "") const {
    return parse_deck("&run units='other' name='case' directory='" + path(subdirectory) + "' " +
                          keys + " /\n" + groups,
                      "case.nml");
  }

  std::filesystem::path directory;
  const RunOptions quiet{0, true};
};

// E = 1, rho = 1, spacing 1: the plate wave speed is near 1, so is the time a bond needs.
inline const char* const kUnitMaterial = "&material name='unit' law='svk' E=1 nu=0.25 rho=1 /\n";
inline const char* const kUnitPlate =
    "&lattice type='square' spacing=1 size=4,3,0 /\n"
    "&body name='plate' kinematics='plane_stress' material='unit' /\n";
inline const char* const kUnitBlock =
    "&lattice type='cubic' spacing=1 size=2,2,3 /\n"
    "&body name='block' kinematics='3d' material='unit' /\n";

inline std::string file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Columns of a history in CSV by name, without their units.
inline std::map<std::string, std::vector<double>> read_history(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string cell; std::getline(header, cell, ',');) {
    names.push_back(cell.substr(0, cell.find(' ')));
  }
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::size_t k = 0;
    for (std::string cell; std::getline(cells, cell, ',');) {
      columns[names.at(k++)].push_back(std::stod(cell));
    }
  }
  return columns;
}

// What a call throws as E; empty if it throws nothing.
template <class E, class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const E& error) {
    return error.what();
  }
  return {};
}

// Whether `text` contains `part`, with both shown if not.
inline ::testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "no \"" << part << "\" in: " << text;
}

// Triangles of a rectangle of nx * ny unit cells, diagonals from lower left to upper right.
inline BodyGeometry unit_cells(std::int64_t nx, std::int64_t ny) {
  BodyGeometry body;
  body.name = "cells";
  body.dimension = 2;
  for (std::int64_t j = 0; j <= ny; ++j) {
    for (std::int64_t i = 0; i <= nx; ++i) {
      body.X.insert(body.X.end(), {static_cast<double>(i), static_cast<double>(j), 0.0});
      body.point_ids.push_back(static_cast<std::int64_t>(body.point_ids.size()) + 1);
    }
  }
  for (std::int64_t j = 0; j < ny; ++j) {
    for (std::int64_t i = 0; i < nx; ++i) {
      const auto a = static_cast<std::int32_t>(j * (nx + 1) + i), b = a + 1;
      const auto d = static_cast<std::int32_t>(a + nx + 1), c = d + 1;
      body.simplices.insert(body.simplices.end(), {a, b, c, a, c, d});
    }
  }
  return body;
}

}  // namespace cleave::driver::testing
