// How idle threads of the kernels wait for the next loop.
#pragma once

namespace cleave::driver {

// Short loops follow each other: a waiting thread should spin a little, then sleep. GNU OpenMP by
// default spins for long, which on a busy machine takes the core from the thread it waits for.
// Measured on the branching plate, two threads: idle machine 4.9 s instead of 4.7 s, busy machine 8.3 s
// instead of 134 s. The runtime reads its setting when the program is loaded, so this starts the
// program anew with it, once; a setting of the user (GOMP_SPINCOUNT or OMP_WAIT_POLICY) is kept.
void let_waiting_threads_sleep(char** argv);

}  // namespace cleave::driver
