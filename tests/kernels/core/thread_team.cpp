// The team of threads: every block once, waiting that orders memory, and what hosts do to it: several
// teams at once, a fork, a system that refuses threads, signals, another rounding mode.
#include "core/thread_team.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cfenv>
#include <csignal>
#include <fstream>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "support/allocations.hpp"

namespace cleave {
namespace {

using Counts = std::vector<std::int64_t>;

Counts visits(ThreadTeam& team, std::int64_t count) {
  Counts found(static_cast<std::size_t>(count));
  team.for_blocks(count, [&](std::int64_t b) { ++found[static_cast<std::size_t>(b)]; });
  return found;
}

bool works(ThreadTeam& team) {
  for (int repeat = 0; repeat < 20; ++repeat)
    if (visits(team, 97) != Counts(97, 1)) return false;
  return true;
}

// No block ends before all workers are here: each of them runs one.
template <class F>
void with_everyone(ThreadTeam& team, const F& f) {
  std::atomic<int> here = 0;
  team.for_blocks(team.size(), [&](std::int64_t block, int worker) {
    f(block, worker);
    ++here;
    while (here.load() < team.size()) std::this_thread::yield();
  });
}

int threads_of_this_process() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("Threads:")) return std::stoi(line.substr(8));
  return -1;
}

// Whether `work` is true in a child process; one that hangs is ended by an alarm.
bool true_in_child(const std::function<bool()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    _exit(work() ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status == 0;
}

TEST(ThreadTeam, RunsEveryBlockOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadTeam team(threads);
    for (const std::int64_t count : {0, 1, 2, 3, 7, 100, 1001})
      EXPECT_EQ(visits(team, count), Counts(static_cast<std::size_t>(count), 1));
  }
}

// Thousands of short loops, each of which reads what others wrote in the one before.
TEST(ThreadTeam, EveryLoopSeesTheOneBefore) {
  constexpr std::size_t kBlocks = 7;
  for (const int threads : {2, 5}) {
    ThreadTeam team(threads);
    std::vector<std::int64_t> a(kBlocks, 0), b(kBlocks, 0);
    for (int repeat = 0; repeat < 3000; ++repeat) {
      team.for_blocks(kBlocks, [&](std::int64_t block) {
        const auto k = static_cast<std::size_t>(block);
        b[k] = std::accumulate(a.begin(), a.end(), std::int64_t{0}) % 1000003;
      });
      team.for_blocks(kBlocks, [&](std::int64_t block) {
        const auto k = static_cast<std::size_t>(block);
        a[k] = b[kBlocks - 1 - k] + block;
      });
    }
    std::vector<std::int64_t> alone(kBlocks, 0);
    for (int repeat = 0; repeat < 3000; ++repeat) {
      const std::int64_t sum = std::accumulate(alone.begin(), alone.end(), std::int64_t{0});
      for (std::size_t k = 0; k < kBlocks; ++k)
        alone[k] = sum % 1000003 + static_cast<std::int64_t>(k);
    }
    EXPECT_EQ(a, alone);
  }
}

// Block 0 ends only when all others have: whoever begins with it does not hold up its share.
TEST(ThreadTeam, BlocksOfOneWhoIsHeldUpAreTakenByOthers) {
  constexpr std::int64_t kBlocks = 100;
  for (const std::int64_t slow : {std::int64_t{0}, kBlocks - 1}) {
    ThreadTeam team(2);
    std::atomic<std::int64_t> others = 0;
    team.for_blocks(kBlocks, [&](std::int64_t block) {
      if (block == slow) {
        while (others.load() < kBlocks - 1) std::this_thread::yield();
      } else {
        ++others;
      }
    });
    EXPECT_EQ(others.load(), kBlocks - 1);
  }
}

TEST(ThreadTeam, WorkersAreNumberedAndTheCallerIsTheFirst) {
  constexpr int kThreads = 4;
  ThreadTeam team(kThreads);
  EXPECT_EQ(team.size(), kThreads);
  std::vector<std::set<std::thread::id>> who(kThreads);
  with_everyone(team, [&](std::int64_t, int worker) {
    who[static_cast<std::size_t>(worker)].insert(std::this_thread::get_id());
  });
  std::set<std::thread::id> all;
  for (const auto& ids : who) {
    ASSERT_EQ(ids.size(), 1u);
    all.insert(*ids.begin());
  }
  EXPECT_EQ(all.size(), std::size_t{kThreads});
  EXPECT_TRUE(who[0].contains(std::this_thread::get_id()));
}

TEST(ThreadTeam, StartsThreadsWithTheFirstLoopAndEndsThemWithIt) {
  const int before = threads_of_this_process();
  if (before < 0) GTEST_SKIP() << "no /proc";
  {
    ThreadTeam team(3);
    EXPECT_EQ(threads_of_this_process(), before);
    EXPECT_TRUE(works(team));
    EXPECT_EQ(threads_of_this_process(), before + 2);
    team.resize(3);
    EXPECT_EQ(threads_of_this_process(), before + 2);
    team.resize(2);
    EXPECT_EQ(threads_of_this_process(), before);
    EXPECT_TRUE(works(team));
    EXPECT_EQ(threads_of_this_process(), before + 1);
    team.resize(1);
    EXPECT_TRUE(works(team));
  }
  EXPECT_EQ(threads_of_this_process(), before);
}

TEST(ThreadTeam, ManyTeamsOfManyHostThreads) {
  std::atomic<int> good = 0;
  std::vector<std::thread> hosts;
  for (int t = 0; t < 4; ++t)
    hosts.emplace_back([&] {
      ThreadTeam team(3);
      good += works(team);
    });
  for (std::thread& host : hosts) host.join();
  EXPECT_EQ(good.load(), 4);
}

TEST(ThreadTeam, MayBeUsedByOneHostThreadAfterAnother) {
  ThreadTeam team(3);
  EXPECT_TRUE(works(team));
  std::thread([&] { EXPECT_TRUE(works(team)); }).join();
  EXPECT_TRUE(works(team));
}

TEST(ThreadTeam, AllocatesNothingInALoop) {
  ThreadTeam team(3);
  EXPECT_TRUE(works(team));
  std::vector<double> a(64);
  const long before = test::allocations();
  for (int repeat = 0; repeat < 100; ++repeat)
    team.for_blocks(64, [&](std::int64_t b) { a[static_cast<std::size_t>(b)] += 1; });
  EXPECT_EQ(test::allocations(), before);
}

// A host forks before the first loop, or after it: the child has no threads but its own.
TEST(ThreadTeam, WorksAfterAFork) {
  ThreadTeam team(3);
  const auto all_work = [](ThreadTeam& t) {
    with_everyone(t, [](std::int64_t, int) {});
    return works(t);
  };
  EXPECT_TRUE(true_in_child([&] { return all_work(team); }));
  EXPECT_TRUE(all_work(team));
  EXPECT_TRUE(true_in_child([&] { return all_work(team); }));
  EXPECT_TRUE(true_in_child([&] {
    team.resize(2);
    return all_work(team) && true_in_child([&] { return all_work(team); });
  }));
  EXPECT_TRUE(all_work(team));
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kAddressSpaceMayBeLimited = false;
#else
constexpr bool kAddressSpaceMayBeLimited = true;
#endif

TEST(ThreadTeam, WorksWithFewerThreadsThanAsked) {
  if (!kAddressSpaceMayBeLimited) GTEST_SKIP() << "the sanitizers need address space";
  EXPECT_TRUE(true_in_child([] {
    const rlimit little{64u << 20, 64u << 20};  // room for a few stacks of 8 MiB
    if (setrlimit(RLIMIT_AS, &little) != 0) return false;
    ThreadTeam team(100);
    return works(team) && threads_of_this_process() < 20;
  }));
}

std::atomic<std::thread::id> handled_by;
void note_thread(int) { handled_by = std::this_thread::get_id(); }

// A signal to the process while only a worker could take it: it waits for the host's thread.
TEST(ThreadTeam, WorkersTakeNoSignals) {
  const auto before = std::signal(SIGUSR1, note_thread);
  ThreadTeam team(2);
  EXPECT_TRUE(works(team));
  sigset_t one, old;
  sigemptyset(&one);
  sigaddset(&one, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &one, &old);
  kill(getpid(), SIGUSR1);
  with_everyone(team, [](std::int64_t, int) {});
  EXPECT_EQ(handled_by.load(), std::thread::id());
  pthread_sigmask(SIG_SETMASK, &old, nullptr);
  EXPECT_EQ(handled_by.load(), std::this_thread::get_id());
  std::signal(SIGUSR1, before);
}

// The host changes its rounding mode when the threads are there already.
TEST(ThreadTeam, WorkersRoundAsTheCallerDoes) {
  ThreadTeam team(3);
  EXPECT_TRUE(works(team));
  const volatile double one = 1, three = 3;
  const auto thirds = [&] {
    std::vector<double> found(3);
    with_everyone(team, [&](std::int64_t block, int) {
      found[static_cast<std::size_t>(block)] = one / three;
    });
    return found;
  };
  const std::vector<double> nearest = thirds();
  std::fesetround(FE_UPWARD);
  const double up = one / three;
  const std::vector<double> upward = thirds();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(upward, std::vector<double>(3, up));
  EXPECT_EQ(nearest, std::vector<double>(3, one / three));
  EXPECT_NE(up, one / three);
  EXPECT_EQ(thirds(), nearest);
}

}  // namespace
}  // namespace cleave
