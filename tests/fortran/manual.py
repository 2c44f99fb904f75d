"""The page manuals/user/hosts/fortran.md, followed to the letter with an installed package: its commands, its output,
its fragments, the message it shows.

    manual.py ROOT PREFIX FORTRAN_COMPILER"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root, prefix, compiler = sys.argv[1:]
page = pathlib.Path(root, "manuals/user/hosts/fortran.md").read_text(encoding="utf-8")
examples = pathlib.Path(root, "manuals/user/hosts/examples")
listings = re.findall(r"(?m)^```text\n(.*?)^```", page, flags=re.S)
fragments = re.findall(r"(?m)^```fortran\n(.*?)^```", page, flags=re.S)
assert len(listings) == 4 and len(fragments) == 2, "the page has other listings than this test knows"
by_cmake, output, by_hand, message = listings


def run(command, folder, fails=False):
    environment = {"PATH": os.environ["PATH"], "CMAKE_GENERATOR": "Ninja", "FC": compiler}
    done = subprocess.run(["bash", "-ec", command], cwd=folder, env=environment, capture_output=True, text=True,
                          check=False)
    if (done.returncode != 0) != fails:
        sys.exit(f"{command}\nreturned {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout if not fails else done.stderr.replace("STOP 1\n", "")


def here(command):
    return command.replace("/opt/cleave", prefix).replace("gfortran ", f"{compiler} ", 1)


def equal(found, expected):
    if not found.endswith(expected):
        sys.exit(f"found:\n{found}\nin the page:\n{expected}")


with tempfile.TemporaryDirectory() as scratch:
    for name in ("bar.f90", "CMakeLists.txt"):
        shutil.copy(examples / name, scratch)
    equal(run(here(by_cmake), scratch), output)
    equal(run(here(by_hand) + "./bar", scratch), output)

    bar = pathlib.Path(scratch, "bar.f90")
    bar.write_text(bar.read_text().replace("1, n, u, H)", "1, n, u(:2, :), H)"))
    equal(run(here(by_hand) + "./bar", scratch, fails=True), message)

    declared, calls = fragments[1].split("\n", 1)
    pathlib.Path(scratch, "fragments.f90").write_text(f"""program fragments
  use, intrinsic :: iso_c_binding
  use cleave
  implicit none
  type(cleave_network) :: network
  {declared}
  integer(c_int32_t) :: status, law = CLEAVE_MATERIAL_j2, failed(5)
  integer :: n = 5
  real(c_double) :: u(5,3), H(5,9), F(5,9), stress(5,6), history(5,8), dt = 1e-6_c_double
  real(c_double) :: properties(7) = [2700.0_c_double, 70e9_c_double, 0.3_c_double, 1e8_c_double, &
      0.0_c_double, 0.0_c_double, 0.0_c_double]
  status = cleave_network_init(network)
{fragments[0]}
  u = 0
  H = 0
  history = 0
  F = 0
  F(:, 1::4) = 1
{calls}
end program fragments
""")
    run(here(by_hand).replace("bar.f90", "fragments.f90"), scratch)
