// A team of threads for the blocks of a loop. One team belongs to one model; nothing is global, so that
// models of several host threads do not meet. It gives out work and waits: it knows nothing of what a
// block is (core/blocks.hpp) and has no sums, because the order of a sum must not depend on threads.
//
// Who asks for a loop is worker 0 and does all of it alone if the others do not come: a loop ends when its
// blocks are done, not when every thread has been there. Every worker begins with a fixed share of the
// blocks, the same in every loop of that many, so that data stay in its cache; who has finished takes
// blocks from the ends of the others' shares. So one busy core costs the blocks that it has begun.
// Measured: blocks in the order of arrival instead of shares, 25 to 30 % slower on free cores; shares that
// nobody takes from, half as fast on busy ones.
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>

namespace cleave {

class ThreadTeam {
 public:
  explicit ThreadTeam(int threads = 1);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  // Between two loops. Threads start with the next loop that has work for them.
  void resize(int threads);
  int size() const { return size_; }  // workers are 0 ... size() - 1, or fewer

  // f(block) or f(block, worker) once for each block 0 ... count - 1, in any order and at the same time;
  // worker tells apart who runs at the same time, for scratch. All writes of f are visible after it.
  // f must not throw and must not use this team. Where the system refuses threads, fewer do the work.
  template <class F>
  void for_blocks(std::int64_t count, const F& f) {
    const auto call = [&f](std::int64_t block, int worker) {
      if constexpr (std::is_invocable_v<const F&, std::int64_t, int>) {
        f(block, worker);
      } else {
        f(block);
      }
    };
    if (size_ == 1 || count < 2) {
      for (std::int64_t b = 0; b < count; ++b) call(b, 0);
      return;
    }
    using Call = decltype(call);
    run({count, &call, [](const void* c, std::int64_t block, int worker) noexcept {
           (*static_cast<const Call*>(c))(block, worker);
         }});
  }

 private:
  class Crew;
  struct Loop {
    std::int64_t count;
    const void* data;
    void (*block)(const void* data, std::int64_t block, int worker) noexcept;
  };
  void run(const Loop& loop);

  int size_;
  std::unique_ptr<Crew> crew_;  // the threads, once started
};

}  // namespace cleave
