// The OpenRadioss adapter without OpenRadioss: cards of every law through the starter routine, groups of
// every size through the engine routine, against the direct call bit for bit, in the precision of the
// build. The stand-in keeps the names, order and lengths of the user library kit.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>

#include "adapters/fortran_host.hpp"

namespace {

using Real = cleave::test::Real;
constexpr std::size_t kGroup = 129;  // MVSIZ

// What the adapter told its host, of this thread.
thread_local std::string listing;
thread_local int stops = 0;

using Vector = Real[kGroup];
struct UserBuffer {  // as ULAWINTBUF
  std::int32_t ncycle, id, iptr, ipts, iptt;
  Vector r[9], strain_rate[6], strain[6];
  Vector fxx, fyy, fzz, fxy, fyz, fzx, fyx, fzy, fxz;
  Vector stretch[6], strain_increment[6], old_stress[6];
  Vector rho0, temp, dvol, tb, bfrac;
  Vector stress[6], viscous_stress[6], dpla;
};
struct CardBuffer {  // as ULAWBUF
  std::int32_t id = 7;
  char name[500] = {};
};

}  // namespace

extern "C" {
void luser01_(const int* nel, const int* nuparam, const int* nuvar, const int* nfunc,
              const int* ifunc, const int* npf, const Real* tf, const Real* time,
              const Real* timestep, const Real* uparam, const Real* rho, const Real* volume,
              const Real* eint, const int* ngl, Real* soundsp, Real* viscmax, Real* uvar, Real* off,
              Real* sigy, Real* pla, UserBuffer* buffer);
void lecmuser01_(const int* iin, const int* iout, Real* uparam, const int* maxuparam, int* nuparam,
                 int* nuvar, int* ifunc, const int* maxfunc, int* nfunc, Real* parmat,
                 const CardBuffer* buffer);
// The unit numbers of files, opened and closed by name.
void cleave_test_open_(const int* unit, const char* name, std::size_t length);
void cleave_test_close_(const int* unit);
// Routines of OpenRadioss.
void write_iout_(const char* line, const int* length, std::size_t);
void arret_(const int* mode);
void write_iout_(const char* line, const int* length, std::size_t) {
  listing += std::string(line, static_cast<std::size_t>(*length)) + "\n";
}
void arret_(const int* mode) { stops += *mode == 2 ? 1 : 100; }
}

namespace cleave::test {
namespace {

constexpr double kStep = 1e-7;  // [s]
constexpr Real kUntouched = -77;

// ---- the starter

struct Cards {
  std::vector<Real> parameters, stiffness;
  int variables = -1, stops = 0;
  std::string listing;
};

Cards read_cards(const std::string& text) {
  const std::filesystem::path place =
      std::filesystem::temp_directory_path() / ("cleave_cards_" + std::to_string(getpid()));
  const std::string input = place.string() + ".in", output = place.string() + ".out";
  std::ofstream(input) << text;
  std::ofstream(output).flush();
  const int in = 30, out = 31, room = 100, functions = 10;
  int given = -1, function[10] = {}, used = -1;
  Cards cards;
  cards.parameters.assign(static_cast<std::size_t>(room) + 1, kUntouched);
  cards.stiffness.assign(4, kUntouched);
  stops = 0;
  cleave_test_open_(&in, input.c_str(), input.size());
  cleave_test_open_(&out, output.c_str(), output.size());
  const CardBuffer buffer;
  lecmuser01_(&in, &out, cards.parameters.data(), &room, &given, &cards.variables, function,
              &functions, &used, cards.stiffness.data(), &buffer);
  cleave_test_close_(&in);
  cleave_test_close_(&out);
  EXPECT_EQ(used, 0);
  EXPECT_EQ(cards.parameters.back(), kUntouched);
  EXPECT_EQ(cards.stiffness[1], kUntouched);
  cards.parameters.resize(static_cast<std::size_t>(given));
  cards.stops = stops;
  std::stringstream written;
  written << std::ifstream(output).rdbuf();
  cards.listing = written.str();
  std::filesystem::remove(input);
  std::filesystem::remove(output);
  return cards;
}

std::string card_text(const Law& law) {
  std::ostringstream text;
  text.precision(17);
  text << "# a note\n  " << law.capitals << "\n";
  for (std::size_t k = 0; k < law.properties.size(); ++k)
    text << law.properties[k] << (k % 5 == 4 ? "\n\n" : "   ");
  return text.str();
}

// ---- the engine

class Group {
 public:
  Group(const Law& law, std::size_t size)
      : n(size),
        parameters(read_cards(card_text(law)).parameters),
        law_(law),
        buffer_(new UserBuffer{}) {
    for (auto* a : {&volume, &off, &sound, &viscosity, &plastic, &yield}) a->assign(n + 1, 1);
    variables.assign(n * law.history + 1, 0);
    variables.back() = kUntouched;
    for (std::size_t i = 0; i < n; ++i) {
      put(i, kUnit);
      buffer().rho0[i] = static_cast<Real>(law.properties[0]);
      volume[i] = static_cast<Real>(1e-9 * (1 + static_cast<double>(i % 7)));
      numbers.push_back(static_cast<int>(1000 + i));
    }
  }
  UserBuffer& buffer() { return *buffer_; }

  void put(std::size_t i, const Matrix3& F) {
    UserBuffer& b = buffer();
    Real* place[3][3] = {{b.fxx, b.fxy, b.fxz}, {b.fyx, b.fyy, b.fyz}, {b.fzx, b.fzy, b.fzz}};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) place[r][c][i] = static_cast<Real>(F[r][c]);
  }
  Matrix3 stress(std::size_t i) {
    const auto s = [&](std::size_t c) { return static_cast<double>(buffer().stress[c][i]); };
    return {{{s(0), s(3), s(5)}, {s(3), s(1), s(4)}, {s(5), s(4), s(2)}}};
  }
  double variable(std::size_t i, std::size_t k) {
    return static_cast<double>(variables[k * n + i]);
  }

  // What the adapter prints and how often it stops.
  std::string run(double dt = kStep) {
    for (auto* six : {&buffer().stress, &buffer().viscous_stress})
      for (auto& component : *six)
        for (Real& x : component) x = kUntouched;
    listing.clear();
    stops = 0;
    const int nel = static_cast<int>(n), nuparam = static_cast<int>(parameters.size()),
              nuvar = static_cast<int>(law_.history), none = 0;
    const Real time = 0, step = static_cast<Real>(dt), no_table[1] = {};
    const std::vector<Real> zeros(n + 1, 0);
    luser01_(&nel, &nuparam, &nuvar, &none, &none, &none, no_table, &time, &step, parameters.data(),
             zeros.data(), volume.data(), zeros.data(), numbers.data(), sound.data(),
             viscosity.data(), variables.data(), off.data(), yield.data(), plastic.data(),
             buffer_.get());
    EXPECT_EQ(variables.back(), kUntouched);
    for (auto* a : {&off, &sound, &viscosity, &plastic}) EXPECT_EQ(a->back(), 1);
    return listing;
  }

  std::size_t n;
  std::vector<Real> parameters, volume, off, sound, viscosity, plastic, yield, variables;
  std::vector<int> numbers;

 private:
  Law law_;
  std::unique_ptr<UserBuffer> buffer_;
};

double length_of(Real volume) { return std::pow(static_cast<double>(volume), 1.0 / 3); }
Matrix3 as_host(const Matrix3& m) { return rounded(m); }
std::ptrdiff_t plastic_place(const Law& law) {
  std::ptrdiff_t next = 0;
  std::int64_t count = 0;
  ok(cleave_field_table_count(&count));
  for (std::int64_t k = 0; k < count; ++k) {
    cleave_field field;
    field.size = sizeof field;
    ok(cleave_field_table_get(k, &field));
    if (field.owner != law.name) continue;
    if (std::string(field.name) == "equivalent_plastic_strain") return next;
    next += field.components;
  }
  return -1;
}

TEST(OpenRadioss, ReadsTheCardsOfEveryLaw) {
  for (const Law& law : laws(21)) {
    SCOPED_TRACE(law.name);
    const Cards cards = read_cards(card_text(law));
    ASSERT_EQ(cards.stops, 0) << cards.listing;
    ASSERT_EQ(cards.parameters.size(), law.properties.size() + 2);
    EXPECT_EQ(cards.parameters[0], static_cast<Real>(law.material));
    EXPECT_EQ(cards.parameters[1], static_cast<Real>(plastic_place(law) + 1));
    for (std::size_t k = 0; k < law.properties.size(); ++k)
      EXPECT_EQ(static_cast<double>(cards.parameters[k + 2]), law.properties[k]);
    EXPECT_EQ(cards.variables, static_cast<int>(law.history));
    double speed = 0;
    ok(cleave_material_wave_speed(law.material, CLEAVE_3D,
                                  static_cast<std::int64_t>(law.properties.size()),
                                  law.properties.data(), &speed));
    EXPECT_EQ(cards.stiffness[0], static_cast<Real>(law.properties[0] * (speed * speed)));
    EXPECT_NE(cards.listing.find("LAW " + law.name), std::string::npos) << cards.listing;
  }
}

TEST(OpenRadioss, ReadsTheCardsOfTheManual) {
  std::ifstream deck(CLEAVE_RADIOSS_DECK);
  std::string line, cards;
  while (std::getline(deck, line) && line.rfind("/MAT/USER01", 0) != 0) continue;
  ASSERT_TRUE(deck) << CLEAVE_RADIOSS_DECK;
  int own = 0;  // the title and the line with the density are read by the starter itself
  while (std::getline(deck, line) && line[0] != '/')
    if (line[0] != '#' && ++own > 2) cards += line + "\n";
  const Cards read = read_cards(cards);
  EXPECT_EQ(read.stops, 0) << read.listing;
  EXPECT_EQ(
      read.parameters,
      (std::vector<Real>{CLEAVE_MATERIAL_j2_power, 7, static_cast<Real>(7.85e-6),
                         static_cast<Real>(206.9), static_cast<Real>(0.29), static_cast<Real>(0.45),
                         static_cast<Real>(0.00217), static_cast<Real>(0.2)}));
  EXPECT_EQ(read.variables, 8);
}

TEST(OpenRadioss, RefusesWrongCards) {
  const auto refused = [](const std::string& text, const std::string& message) {
    const Cards cards = read_cards(text);
    EXPECT_EQ(cards.stops, 1);
    EXPECT_NE(cards.listing.find("ERROR IN CLEAVE (/MAT/USER01/7)"), std::string::npos)
        << cards.listing;
    EXPECT_NE(cards.listing.find(message), std::string::npos) << cards.listing;
  };
  refused("", "no law is named");
  refused("# j2\n", "no law is named");
  refused("steel 1 2 3\n", "steel");
  refused("svk 1190. 3.24e9\n", "law svk takes 3 properties, not 2");
  refused("svk 1190. 3.24e9 0.3 0.\n", "law svk takes 3 properties, not 4");
  refused("svk 1190. 3.24e9,0.3\n", "'3.24e9,0.3' is not a number");
  refused("svk 1190. E 0.3\n", "is not a number");
  refused("svk 1190. -3.24e9 0.3\n", "E");
}

TEST(OpenRadioss, GroupsOfEverySizeGetTheBitsOfTheDirectCall) {
  for (const Law& law : laws(22)) {
    SCOPED_TRACE(law.name);
    Random random(23);
    double speed = 0;
    ok(cleave_material_wave_speed(law.material, CLEAVE_3D,
                                  static_cast<std::int64_t>(law.properties.size()),
                                  law.properties.data(), &speed));
    const double size = sizeof(Real) == 4 ? 0.05 : 0.1;
    const std::ptrdiff_t place = plastic_place(law);
    for (std::size_t n = 1; n < kGroup; ++n) {
      Group group(law, n);
      Direct direct(law, n);
      for (int cycle = 0; cycle < 2; ++cycle) {
        std::vector<Matrix3> F;
        for (std::size_t i = 0; i < n; ++i) {
          F.push_back(as_host(random_gradient(random, size)));
          group.put(i, F.back());
        }
        ASSERT_EQ(group.run(), "");
        ASSERT_EQ(stops, 0);
        for (std::size_t i = 0; i < n; ++i) {
          const double before = place < 0 ? 0 : direct.history[i][static_cast<std::size_t>(place)];
          const auto answer = direct.step(i, F[i], static_cast<double>(static_cast<Real>(kStep)),
                                          length_of(group.volume[i]));
          const bool dead =
              law.damage >= 0 && direct.history[i][static_cast<std::size_t>(law.damage)] >= 1;
          ASSERT_EQ(group.off[i], dead ? 0 : 1);
          ASSERT_EQ(group.stress(i), dead ? Matrix3{} : rounded(answer.stress)) << n << " " << i;
          for (std::size_t k = 0; k < law.history; ++k)
            ASSERT_EQ(group.variable(i, k), direct.history[i][k]) << k;
          ASSERT_EQ(group.sound[i], static_cast<Real>(speed));
          ASSERT_EQ(group.viscosity[i], 0);
          for (auto& component : group.buffer().viscous_stress) ASSERT_EQ(component[i], 0);
          if (place >= 0) {
            const double now = direct.history[i][static_cast<std::size_t>(place)];
            ASSERT_EQ(static_cast<double>(group.plastic[i]), now);
            ASSERT_EQ(group.buffer().dpla[i], static_cast<Real>(now) - static_cast<Real>(before));
          }
          if (dead)
            group.off[i] = 1, group.variables[static_cast<std::size_t>(law.damage) * n + i] = 0,
            direct.history[i][static_cast<std::size_t>(law.damage)] = 0;
        }
        for (auto& component : group.buffer().stress) ASSERT_EQ(component[n], kUntouched);
      }
    }
  }
}

TEST(OpenRadioss, DeletesWhereDamageIsCompleteOrTheLawHasNoAnswer) {
  Law law = law_called("johnson_cook");
  law.property("D1") = static_cast<double>(static_cast<Real>(0.01));
  Group group(law, 4);
  group.put(0, {{{1.2, 0, 0}, {0, 1, 0}, {0, 0, 1}}});    // torn
  group.put(1, {{{-0.5, 0, 0}, {0, 1, 0}, {0, 0, 1}}});   // inverted
  group.put(2, {{{1.001, 0, 0}, {0, 1, 0}, {0, 0, 1}}});  // well
  group.put(3, {{{1.001, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  group.off[3] = static_cast<Real>(0.8);  // a failure model of the host has begun
  const std::string text = group.run();
  EXPECT_EQ(stops, 0);
  EXPECT_EQ(text,
            " -- CLEAVE: ELEMENT 1001 DELETED, ITS DEFORMATION IS OUTSIDE THE RANGE OF THE LAW\n");
  EXPECT_EQ(group.off, (std::vector<Real>{0, 0, 1, 0, 1}));
  for (const std::size_t i : {0u, 1u, 3u}) EXPECT_EQ(group.stress(i), Matrix3{});
  EXPECT_GT(group.stress(2)[0][0], 0);
  for (std::size_t k = 0; k < law.history; ++k) {
    EXPECT_EQ(group.variable(1, k), 0);
    EXPECT_EQ(group.variable(3, k), 0);
  }
  group.put(1, {});  // what is deleted is not looked at again
  EXPECT_EQ(group.run(), "");
  EXPECT_EQ(stops, 0);
}

TEST(OpenRadioss, EndsTheRunInOrder) {
  const Law law = law_called("j2");
  const auto refused = [](Group& group, const std::string& message) {
    const std::string text = group.run();
    EXPECT_EQ(stops, 1);
    EXPECT_NE(text.find("ERROR IN CLEAVE (/MAT/USER01)"), std::string::npos) << text;
    EXPECT_NE(text.find(message), std::string::npos) << text;
  };
  Group zero(law, 3);
  zero.put(1, {});
  refused(zero, "Ismstr = 10");
  Group light(law, 3);
  light.buffer().rho0[0] *= static_cast<Real>(1.01);
  refused(light, "density on the first card");
  Group unknown(law, 3);
  unknown.parameters[0] = 99;
  refused(unknown, "material number 99");
  Group fewer(law, 3);
  fewer.parameters.pop_back();
  refused(fewer, "takes 7 properties, not 6");
  Law without = law;
  without.history -= 1;
  Group shorter(without, 3);
  refused(shorter, "variables, the restart file");
}

// The stress in the global frame turns with the body, whatever has happened before; nothing of the history
// has to be turned. In a frame G that turns with the element, where the host hands over G^T F G, only
// laws without memory get the stress G^T sigma G.
TEST(OpenRadioss, KeepsItsHistoryWhileTheBodyTurns) {
  if (sizeof(Real) == 4) return;
  Random random(31);
  for (const std::string name : {"j2", "johnson_cook", "neo_hooke"}) {
    const Law law = law_called(name);
    Group turned(law, 16), local(law, 16);
    Direct still(law, 16);
    bool same_in_turning_frame = true;
    for (int cycle = 0; cycle < 3; ++cycle) {
      std::vector<Matrix3> F, Q;
      for (std::size_t i = 0; i < turned.n; ++i) {
        F.push_back(random_gradient(random, 0.05));
        Q.push_back(cycle == 0 ? kUnit : rotation(random));
        turned.put(i, product(Q[i], F[i]));
        local.put(i, product(transposed(Q[i]), product(product(Q[i], F[i]), Q[i])));
      }
      turned.run();
      local.run();
      for (std::size_t i = 0; i < turned.n; ++i) {
        const Matrix3 s = still.step(i, F[i], kStep, length_of(turned.volume[i])).stress;
        const Matrix3 wanted = product(Q[i], product(s, transposed(Q[i])));
        const Matrix3 found = turned.stress(i), in_frame = local.stress(i);
        for (std::size_t r = 0; r < 3; ++r)
          for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[r][c], wanted[r][c], 1e-12 * 1e9)
                << name;  // measured 1e-14 of the modulus
            if (std::fabs(in_frame[r][c] - s[r][c]) > 1e6) same_in_turning_frame = false;
          }
        for (std::size_t k = 0; k < law.history; ++k)
          EXPECT_NEAR(turned.variable(i, k), still.history[i][k],
                      1e-10 * std::fabs(still.history[i][k]) + 1e-13);
      }
    }
    EXPECT_EQ(same_in_turning_frame, law.history == 0) << name;
  }
}

TEST(OpenRadioss, ThreadsOfTheHostGetTheBitsOfOne) {
  const Law law = law_called("j2");
  const auto worked = [&](unsigned seed) {
    Random random(seed);
    Group group(law, 128);
    for (int cycle = 0; cycle < 20; ++cycle) {
      for (std::size_t i = 0; i < group.n; ++i) group.put(i, random_gradient(random, 0.05));
      group.run();
    }
    return group.variables;
  };
  std::vector<Group> groups;
  for (int t = 0; t < 4; ++t) groups.emplace_back(law, 128);  // cards are read by one thread
  const auto cycles = [](Group& group, unsigned seed) {
    Random random(seed);
    for (int cycle = 0; cycle < 20; ++cycle) {
      for (std::size_t i = 0; i < group.n; ++i) group.put(i, random_gradient(random, 0.05));
      group.run();
    }
  };
  std::vector<std::thread> team;
  for (unsigned t = 0; t < 4; ++t) team.emplace_back([&, t] { cycles(groups[t], t + 1); });
  for (std::thread& member : team) member.join();
  for (unsigned t = 0; t < 4; ++t) EXPECT_EQ(groups[t].variables, worked(t + 1));
}

}  // namespace
}  // namespace cleave::test
