#include "core/thread_team.hpp"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <vector>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace cleave {
namespace {

constexpr std::size_t kLine = 64;         // bytes of a cache line: what threads write lies apart
constexpr int kMostThreads = 1024;        // more are not started
constexpr std::size_t kStack = 8u << 20;  // bytes, only reserved, whatever `ulimit -s` says

// Spinning before sleeping: longer than the serial work between two loops of a small body, much shorter than
// a time slice, so that little is lost where another program needs the core. Measured, two threads, a step of
// 14 000 particles in the plane on free cores: 860 us without spinning, 650 us with 20, 50 or 200 us of it
// (one thread: 1270 us); beside thirteen other programs on the two cores: no slower than one thread.
constexpr std::chrono::microseconds kSpin{50};

void relax() {
#if defined(__SSE2__)
  _mm_pause();
#elif defined(__aarch64__)
  __asm__ __volatile__("isb");
#endif
}

// Waits until value is not `old`.
template <class T>
void wait_for_change(const std::atomic<T>& value, T old) {
  if (value.load(std::memory_order_acquire) != old) return;
  const auto end = std::chrono::steady_clock::now() + kSpin;
  do {
    for (int k = 0; k < 16; ++k) {
      relax();
      if (value.load(std::memory_order_acquire) != old) return;
    }
  } while (std::chrono::steady_clock::now() < end);
  value.wait(old, std::memory_order_acquire);
}

// How the host's thread rounds, and whether it flushes denormal numbers: workers do the same, or bits would
// depend on threads. The part of the control register without the flags of what has happened.
#if defined(__SSE2__)
constexpr unsigned kFloatFlags = 0x3f;
std::uint64_t float_control() { return _mm_getcsr() & ~kFloatFlags; }
void set_float_control(std::uint64_t control) { _mm_setcsr(static_cast<unsigned>(control)); }
#elif defined(__aarch64__)
std::uint64_t float_control() {
  std::uint64_t control;
  __asm__ __volatile__("mrs %0, fpcr" : "=r"(control));
  return control;
}
void set_float_control(std::uint64_t control) {
  __asm__ __volatile__("msr fpcr, %0" : : "r"(control));
}
#else
std::uint64_t float_control() { return 0; }
void set_float_control(std::uint64_t) {}
#endif

// What is left of one worker's blocks: [first, last), both in one word, so that a block is taken by one
// exchange. A share is filled only after all blocks of the loop before are done, so whoever takes a block,
// however late it looked, has one of the loop that runs now.
class alignas(kLine) Share {
 public:
  void fill(std::uint64_t first, std::uint64_t last) {
    left_.store(first << 32 | last, std::memory_order_release);
  }
  bool take_first(std::int64_t& block) {
    return take([&](std::uint64_t first, std::uint64_t last) {
      block = static_cast<std::int64_t>(first);
      return (first + 1) << 32 | last;
    });
  }
  bool take_last(std::int64_t& block) {
    return take([&](std::uint64_t first, std::uint64_t last) {
      block = static_cast<std::int64_t>(last - 1);
      return first << 32 | (last - 1);
    });
  }

 private:
  template <class Rest>
  bool take(const Rest& rest) {
    std::uint64_t left = left_.load(std::memory_order_acquire);
    for (;;) {
      const std::uint64_t first = left >> 32, last = left & 0xffffffffu;
      if (first >= last) return false;
      if (left_.compare_exchange_weak(left, rest(first, last), std::memory_order_acq_rel,
                                      std::memory_order_acquire))
        return true;
    }
  }
  std::atomic<std::uint64_t> left_ = 0;
};

// No signal handler of the host runs in a worker. What a fault raises stays with the thread at fault.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT})
      sigdelset(&all, fault);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_;
};

}  // namespace

class ThreadTeam::Crew {
 public:
  explicit Crew(int size);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  // A process that was forked off has memory but no workers.
  bool is_here() const { return process_ == getpid(); }
  void run(const Loop& loop);

 private:
  struct Member {
    Crew* crew;
    int worker;
    pthread_t thread;
  };
  static void* member(void* self);
  void work(int worker);
  bool take(int worker, std::int64_t& block);
  void take_part(int worker);

  const pid_t process_ = getpid();
  std::vector<Share> shares_;
  std::vector<Member> members_;  // without worker 0
  Loop loop_{};
  std::uint64_t float_control_ = 0;
  std::atomic<bool> over_ = false;
  alignas(kLine) std::atomic<std::uint32_t> turn_ = 0;  // counts loops: what workers wait for
  alignas(kLine) std::atomic<std::uint32_t> done_ = 0;  // blocks: what worker 0 waits for
};

ThreadTeam::Crew::Crew(int size) : shares_(static_cast<std::size_t>(size)) {
  members_.reserve(shares_.size());
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return;
  pthread_attr_setstacksize(&attributes, kStack);
  const SignalsBlocked blocked;
  for (int worker = 1; worker < size; ++worker) {
    Member& m = members_.emplace_back(Member{this, worker, {}});
    if (pthread_create(&m.thread, &attributes, member, &m) != 0) {
      members_.pop_back();
      break;
    }
  }
  pthread_attr_destroy(&attributes);
}

ThreadTeam::Crew::~Crew() {
  if (!is_here()) return;
  over_.store(true);
  turn_.fetch_add(1);
  turn_.notify_all();
  for (const Member& m : members_) pthread_join(m.thread, nullptr);
}

void* ThreadTeam::Crew::member(void* self) {
  const Member& m = *static_cast<const Member*>(self);
  m.crew->work(m.worker);
  return nullptr;
}

void ThreadTeam::Crew::work(int worker) {
  for (std::uint32_t seen = 0;;) {
    wait_for_change(turn_, seen);
    seen = turn_.load(std::memory_order_acquire);
    if (over_.load()) return;
    take_part(worker);
  }
}

bool ThreadTeam::Crew::take(int worker, std::int64_t& block) {
  const std::size_t size = shares_.size(), own = static_cast<std::size_t>(worker);
  if (shares_[own].take_first(block)) return true;
  for (std::size_t k = 1; k < size; ++k)
    if (shares_[(own + k) % size].take_last(block)) return true;
  return false;
}

void ThreadTeam::Crew::take_part(int worker) {
  std::int64_t block = 0;
  if (!take(worker, block)) return;
  // From here to the addition below the loop cannot end, nor the next begin.
  const Loop loop = loop_;
  if (worker != 0 && float_control() != float_control_) set_float_control(float_control_);
  std::uint32_t own = 0;
  do {
    loop.block(loop.data, block, worker);
    ++own;
  } while (take(worker, block));
  if (done_.fetch_add(own) + own == loop.count && worker != 0) done_.notify_one();
}

void ThreadTeam::Crew::run(const Loop& loop) {
  loop_ = loop;
  float_control_ = float_control();
  done_.store(0, std::memory_order_relaxed);
  const auto count = static_cast<std::uint64_t>(loop.count), size = shares_.size();
  for (std::uint64_t k = 0; k < size; ++k)
    shares_[k].fill(count * k / size, count * (k + 1) / size);
  turn_.fetch_add(1);
  turn_.notify_all();
  take_part(0);
  for (;;) {
    const std::uint32_t done = done_.load(std::memory_order_acquire);
    if (done == loop.count) return;
    wait_for_change(done_, done);
  }
}

ThreadTeam::ThreadTeam(int threads) : size_(threads) {}
ThreadTeam::~ThreadTeam() = default;

void ThreadTeam::resize(int threads) {
  if (threads == size_) return;
  crew_.reset();
  size_ = threads;
}

void ThreadTeam::run(const Loop& loop) {
  if (!crew_ || !crew_->is_here()) crew_ = std::make_unique<Crew>(std::min(size_, kMostThreads));
  crew_->run(loop);
}

}  // namespace cleave
