"""SIGKILL at random times: runs and restarts are killed again and again until one ends, and the files are
those of the uninterrupted run.

  killed.py PROGRAM [--full] [--seed N]

Two dozen kills; with --full a thousand. The times come from the seed, what the process does then does not."""

import random
import subprocess
import sys
import time

from small_run import SmallRun, checkpoints, report, scratch_folder

CHAIN = 6  # kills of one run; then it may end


def kill_once(run, folder, delay, threads):
    """Starts or goes on, and kills; True if it was still running."""
    words = ["restart", "."] if checkpoints(folder) else ["case.nml", "--quiet"]
    process = subprocess.Popen(run.command(*words, threads=threads), cwd=folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(delay)
    alive = process.poll() is None
    process.kill()
    process.wait()
    return alive


def chain(run, number, generator, seconds, kills):
    """Kills of one run, and its end."""
    folder = run.folder(f"chain-{number}")
    hits = sum(kill_once(run, folder, generator.uniform(0.1, 1.1) * seconds, generator.choice([1, 2]))
               for _ in range(kills))
    saved = len(checkpoints(folder))
    run.finish(folder, threads=generator.choice([1, 2]))
    return hits, saved


def main(program, full, seed):
    generator = random.Random(seed)
    wanted, hits, chains, after_checkpoints, failures = 1000 if full else 24, 0, 0, 0, []
    with scratch_folder() as root:
        run = SmallRun(program, root)
        begin = time.monotonic()
        run.start(run.folder("timed"))
        seconds = time.monotonic() - begin
        while hits < wanted:
            chains += 1
            try:
                more, saved = chain(run, chains, generator, seconds, CHAIN)
                hits += more
                after_checkpoints += saved > 0
            except AssertionError as error:
                failures.append(f"chain {chains} of seed {seed}: {error}")
                hits += CHAIN
            if chains > 20 * wanted:
                sys.exit(f"FAILED: {hits} kills in {chains} chains: the run ends before it is killed")
    print(f"{hits} kills in {chains} runs, {after_checkpoints} of them with a checkpoint")
    if after_checkpoints == 0:
        failures.append("no kill came after a checkpoint: the times are wrong")
    report(failures, f"{chains} runs killed at random times")


if __name__ == "__main__":
    main(sys.argv[1], "--full" in sys.argv,
         int(sys.argv[sys.argv.index("--seed") + 1]) if "--seed" in sys.argv else 5)
